//! `virtwall scene show`: what a scene contains, in numbers and as a picture.

use std::path::PathBuf;

use clap::Args;
use config::{decimal, short_name};
use lab::{OpenScene, Solved, Stage, Which};
use radiosity::glam::DVec3;
use radiosity::{
    Camera, LocalEnvironment, PatchSize, Picture, PictureOptions, Rgb, Space, render, studio_light,
};

use crate::arguments::direction;
use crate::exit::{Exit, print_warnings};
use crate::files::{check_writable, write};
use crate::render::solved;

/// The share of the light that may be unshot in a picture.
const UNSHOT: f64 = 0.1;

#[derive(Args)]
pub struct Arguments {
    /// Name of a scene, or path to a scene description (.json) or an OBJ file
    scene: String,
    /// Draw a picture to this PNG file
    #[arg(long, value_name = "OUT")]
    png: Option<PathBuf>,
    /// Direction that is up in the picture [default: as the scene description says, else 0,0,1]
    #[arg(long, value_name = "X,Y,Z", value_parser = direction, allow_hyphen_values = true)]
    up: Option<DVec3>,
    /// Leave out of the picture what is above this height, in metres
    #[arg(long, value_name = "HEIGHT", allow_hyphen_values = true)]
    cut_above: Option<f64>,
    /// Show materials and lights without solving [default]
    #[arg(long, conflicts_with = "solved")]
    emitted: bool,
    /// Show the solution with at most 10 % of the light unshot
    #[arg(long)]
    solved: bool,
}

/// Draws the picture, if one is asked for; returns the numbers.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    if arguments.cut_above.is_some_and(|height| !height.is_finite()) {
        return Err(Exit::bad_input("--cut-above: not a height; expected metres, such as 2.5"));
    }
    arguments.png.iter().try_for_each(|path| check_writable(path))?;
    let open = OpenScene::load(&arguments.scene)?;
    print_warnings(open.all_warnings());
    let (_, whole) = meshed(&open);
    let mut text = numbers(&open, &whole);
    if let Some(path) = &arguments.png {
        let (picture, unshot) = picture(&open, arguments)?;
        text += &unshot;
        let bytes = picture.encode_png().map_err(Exit::failure)?;
        write(path, &bytes)?;
    }
    Ok(text)
}

/// The numbers of a scene.
pub fn show(name: &str) -> Result<String, Exit> {
    let open = OpenScene::load(name)?;
    print_warnings(open.all_warnings());
    Ok(numbers(&open, &meshed(&open).1))
}

/// The scene in its grid, meshed as one environment.
pub fn meshed(open: &OpenScene) -> (Space, LocalEnvironment) {
    let space = Space::new(open.scene.clone(), open.cells);
    let size = PatchSize { reflector: open.patch_size, emitter: open.emitter_patch_size };
    let whole = LocalEnvironment::new(&space, space.grid.whole(), size);
    (space, whole)
}

fn numbers(open: &OpenScene, whole: &LocalEnvironment) -> String {
    let scene = &open.scene;
    let world = |local: Rgb| (local + scene.origin).to_array().map(|c| decimal(c, 2)).join(" ");
    let power = scene.emitted_power().to_array().map(|watts| decimal(watts, 1)).join(" ");
    let lights = scene.polygons.iter().filter(|p| scene.material(p).emission != Rgb::ZERO).count();
    let [x, y, z] = open.cells;
    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:<16}{value}\n");
    open.title.iter().for_each(|title| line("title", short_name(title)));
    line("polygons", format!("{}, {lights} of them lights", scene.polygons.len()));
    line("vertices", scene.vertices.len().to_string());
    line("materials", scene.materials.len().to_string());
    line("objects", scene.objects.len().to_string());
    line("bounds", format!("{} to {} m", world(scene.bounds.min), world(scene.bounds.max)));
    line("area", format!("{} m²", decimal(scene.area(), 1)));
    line("emitted power", format!("{power} W (red, green, blue)"));
    line(
        "patch size",
        format!("{:.3} m, of lights {:.3} m", open.patch_size, open.emitter_patch_size),
    );
    line("patches", format!("{} before any cut", whole.patches.len()));
    line("cells", format!("{x} x {y} x {z}"));
    for medium in &scene.media {
        let [min, max] = [medium.bounds.min, medium.bounds.max].map(world);
        line("medium", format!("{min} to {max} m absorbs {} /m", medium.absorption));
    }
    text
}

fn picture(open: &OpenScene, arguments: &Arguments) -> Result<(Picture, String), Exit> {
    let up = arguments.up.unwrap_or(open.scene.up);
    let camera = Camera::overview(&open.scene.bounds, up, 1200, 800);
    let cut_above = arguments.cut_above.map(|height| (up, height - open.scene.origin.dot(up)));
    let options = PictureOptions { cut_above, ..PictureOptions::default() };
    if !arguments.solved {
        let picture = render(&open.scene, &camera, studio_light(&open.scene, up), options);
        return Ok((picture.map_err(Exit::bad_input)?, String::new()));
    }
    let stage = Stage::open(&arguments.scene, &Which { set: &[], row: None })?;
    let Solved { light, left, shots } = solved(&stage, UNSHOT);
    let whole = &stage.environments()[0];
    let colour = |polygon, point| {
        whole.patch_at(polygon, point).map_or(Rgb::ZERO, |patch| light[0][patch as usize])
    };
    let picture =
        render(&stage.space().scene, &camera, colour, options).map_err(Exit::bad_input)?;
    let unshot = format!("{:.1} % of the light after {shots} shots", 100.0 * left);
    Ok((picture, format!("{:<16}{unshot}\n", "unshot")))
}
