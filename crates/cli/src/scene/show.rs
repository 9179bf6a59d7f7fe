//! `virtwall scene show`: what a scene contains, in numbers and as a picture.

use std::path::{Path, PathBuf};

use clap::Args;
use config::{decimal, short_name};
use lab::{FirstLight, OpenScene, Stage, Which, percent};
use radiosity::{LocalEnvironment, PatchSize, Rgb, Space, render, studio_light};

use crate::exit::{Exit, print_warnings};
use crate::files::{check_writable, write};
use crate::render::{Look, draw_solution};

#[derive(Args)]
pub struct Arguments {
    /// Name of a scene, or path to a scene description (.json) or an OBJ file
    scene: String,
    /// Draw a picture to this PNG file: the solution with at most 10 % of the light unshot, the same
    /// picture as that of `virtwall render`
    #[arg(short, long, alias = "png", value_name = "PNG")]
    output: Option<PathBuf>,
    #[command(flatten)]
    look: Look,
    /// Draw materials and lights without solving
    #[arg(long)]
    emitted: bool,
    /// Draw the solution, as is done by default
    #[arg(long, hide = true, conflicts_with = "emitted")]
    solved: bool,
}

/// Draws the picture, if one is asked for; returns the numbers.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    arguments.output.iter().try_for_each(|path| check_writable(path))?;
    let open = OpenScene::load(&arguments.scene)?;
    print_warnings(open.all_warnings());
    let mut text = numbers(&open, &meshed(&open).1);
    match &arguments.output {
        Some(path) if arguments.emitted => draw_emitted(&open, &arguments.look, path)?,
        Some(path) => {
            let stage = Stage::open(&arguments.scene, &Which { set: &[], row: None })?;
            let left = draw_solution(&stage, &arguments.look, path)?;
            text += &format!("{:<16}{left}\n", "picture");
        }
        None => {}
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
    let world = |local: Rgb| {
        let place = local + scene.origin;
        // What adding and subtracting the origin leaves of a zero.
        let rounding = 2.0 * f64::EPSILON * scene.origin.abs().max_element();
        let exact = |c: f64| if c.abs() <= rounding { 0.0 } else { c };
        place.to_array().map(|c| decimal(exact(c), 2)).join(" ")
    };
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
    if let Some(FirstLight { fronts, backs, leaves, .. }) = open.first_light {
        let [fronts, backs, leaves] = [fronts, backs, leaves].map(percent);
        let falls =
            format!("{fronts} falls on fronts, {backs} on backs, {leaves} leaves the scene");
        line("light of lamps", falls);
    }
    let [size, of_lights] = [open.patch_size, open.emitter_patch_size].map(|m| decimal(m, 3));
    line("patch size", format!("{size} m, of lights {of_lights} m"));
    line("patches", format!("{} before any cut", whole.patches.len()));
    line("cells", format!("{x} x {y} x {z}"));
    for medium in &scene.media {
        let [min, max] = [medium.bounds.min, medium.bounds.max].map(world);
        line("medium", format!("{min} to {max} m absorbs {} /m", medium.absorption));
    }
    text
}

/// Draws materials and lights, without solving.
fn draw_emitted(open: &OpenScene, look: &Look, path: &Path) -> Result<(), Exit> {
    let scene = &open.scene;
    let options = look.options(scene, look.exposure());
    let light = studio_light(scene, look.up(scene));
    let picture = render(scene, &look.camera(scene)?, light, options).map_err(Exit::bad_input)?;
    write(path, picture.encode_png().map_err(Exit::failure)?)
}
