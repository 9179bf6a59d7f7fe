//! `virtwall render`: draws a scene, or any instant of a run, as a picture, an animation or a glTF file.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use config::{Dimension, decimal, parse, short_name};
use desim::Time;
use lab::{Light, Solved, Stage, Which};
use radiosity::glam::DVec3;
use radiosity::{
    Camera, Exposure, LARGEST_PICTURE, Mesh, Picture, PictureOptions, Rgb, Shading, Tone, render,
};

use crate::arguments::{direction, number, point};
use crate::exit::{Exit, print_note, print_warnings};
use crate::files::{check_writable, write};
use crate::steps::Steps;

/// The most frames whose light is in memory at one time.
const BATCH: usize = 32;

#[derive(Args)]
pub struct Arguments {
    /// A scene (name, description or OBJ file), which is solved without simulation; or an experiment or
    /// a folder of results, one run of which is simulated again
    what: String,
    /// Write a picture to this PNG file
    #[arg(short, long, value_name = "PNG", required_unless_present = "gltf", value_parser = png)]
    output: Option<PathBuf>,
    /// Write the patches to this binary glTF file, with vertex attributes COLOR_0 (as in a picture, with
    /// exposure and tone) and _RADIOSITY (W/m²)
    #[arg(long, value_name = "GLB", conflicts_with = "frames")]
    gltf: Option<PathBuf>,
    #[command(flatten)]
    moment: Moment,
    #[command(flatten)]
    view: View,
    /// Shading of patches
    #[arg(long, value_enum, default_value = "smooth")]
    shading: ShadingArgument,
    /// Radiosity that is shown as middle grey, W/m² [default: the geometric mean of what the picture
    /// shows, for runs at their end; for a glTF file alone that of all patches]
    #[arg(long, value_name = "W/M2", value_parser = positive)]
    exposure: Option<f64>,
    /// Tone mapping
    #[arg(long, value_enum, default_value = "reinhard")]
    tone: ToneArgument,
}

#[derive(Args)]
struct Moment {
    /// Solve a scene until at most this share of the light is unshot, or for 100,000 shots; a warning says
    /// if they were not enough
    #[arg(long, value_name = "SHARE", default_value = "10 %", value_parser = share)]
    unshot: f64,
    /// Which run: its row in runs.csv, from 1 [default: the last]
    #[arg(long, value_name = "ROW")]
    run: Option<usize>,
    /// Override a value of the experiment, as for `virtwall run`
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Virtual time, such as "3.2 s" [default: the end]
    #[arg(long, value_name = "TIME", value_parser = instant)]
    at: Option<Time>,
    /// Draw N pictures at equal intervals from the start to the end, as PNG-001.png and so on
    #[arg(long, value_name = "N", conflicts_with = "at", requires = "output")]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=10_000))]
    frames: Option<u32>,
}

/// The camera. Coordinates are the scene's, in metres.
#[derive(Args)]
struct View {
    /// Position of the camera, unless --eye and --target are given
    #[arg(long, value_enum, default_value = "outside")]
    camera: CameraArgument,
    /// Position of the camera
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    eye: Option<DVec3>,
    /// Point that it looks at
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    target: Option<DVec3>,
    /// Direction that is up in pictures and glTF files [default: as the scene description says, else
    /// 0,0,1]
    #[arg(long, value_name = "X,Y,Z", value_parser = direction, allow_hyphen_values = true)]
    up: Option<DVec3>,
    /// Vertical field of view, degrees
    #[arg(long, value_name = "DEGREES", value_parser = angle)]
    field_of_view: Option<f64>,
    /// Size of the picture, pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1200x800", value_parser = size)]
    size: (u32, u32),
    /// Leave out of pictures what is above this height, metres. With --eye, height is along the
    /// scene's own upward direction, whatever --up says
    #[arg(long, value_name = "HEIGHT", value_parser = number, allow_hyphen_values = true)]
    cut_above: Option<f64>,
}

#[derive(Clone, Copy, ValueEnum)]
enum CameraArgument {
    /// From outside and above; backs of walls are not drawn
    Outside,
    /// In a corner of the scene
    Inside,
}

#[derive(Clone, Copy, ValueEnum)]
enum ShadingArgument {
    /// Interpolated from means at corners, within one plane of one object
    Smooth,
    /// One colour per patch
    Flat,
}

#[derive(Clone, Copy, ValueEnum)]
enum ToneArgument {
    /// Photographic, with soft highlights (Reinhard 2002)
    Reinhard,
    /// Proportional and clipped: radiosity can be computed from a picture
    Linear,
}

/// Draws; returns what was drawn.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let Moment { set, run, at, frames, .. } = &arguments.moment;
    arguments.output.iter().chain(&arguments.gltf).try_for_each(|path| check_writable(path))?;
    let stage = Stage::open(&arguments.what, &Which { set, row: *run })?;
    print_warnings(&stage.warnings);
    if stage.run.is_none() && (at.is_some() || frames.is_some() || run.is_some() || !set.is_empty())
    {
        let message = format!("{}: a scene; expected an experiment or results", arguments.what);
        return Err(Exit::bad_input(message + " for --at, --frames, --run and --set"));
    }
    let (width, height) = arguments.view.size;
    let scene = &stage.space().scene;
    let camera = arguments.view.camera(scene).map_err(Exit::bad_input)?;
    let shading = match arguments.shading {
        ShadingArgument::Smooth => Shading::Smooth,
        ShadingArgument::Flat => Shading::Flat,
    };
    let renderer = Renderer {
        arguments,
        stage: &stage,
        mesh: Mesh::new(stage.space(), stage.environments(), shading),
        camera,
    };
    let drawn = match (frames, &arguments.output) {
        (Some(frames), Some(output)) => renderer.animation(*frames, output)?,
        _ => renderer.still()?,
    };
    let text = format!("{}\n{drawn}", short_name(&stage.title));
    Ok(if arguments.output.is_some() {
        text + &format!("{width} x {height} pixels\n")
    } else {
        text
    })
}

/// The light of a scene; warns if more is left than what was asked for.
pub fn solved(stage: &Stage, unshot: f64) -> Solved {
    let (steps, watch) = Steps::of_light(unshot);
    let solved = stage.solved(unshot, watch);
    steps.end();
    solved.warning(unshot).iter().for_each(|warning| print_note(&format!("warning: {warning}")));
    solved
}

struct Renderer<'a> {
    arguments: &'a Arguments,
    stage: &'a Stage,
    mesh: Mesh<'a>,
    camera: Camera,
}

impl Renderer<'_> {
    fn still(&self) -> Result<String, Exit> {
        let (light, mut exposure, when) = match &self.stage.run {
            None => {
                let Solved { light, left, shots } =
                    solved(self.stage, self.arguments.moment.unshot);
                let when = format!("{:.1} % of the light unshot after {shots} shots", 100.0 * left);
                (light, self.exposure(), when)
            }
            Some(run) => {
                let at = self.arguments.moment.at.unwrap_or(Time::MAX);
                let (mut light, end) = self.light_at(&[at, Time::MAX])?;
                let when =
                    format!("run {} at {} of {}", run.row, seconds(at.min(end)), seconds(end));
                (light.swap_remove(0), self.exposure_of_end(&light[0])?, when)
            }
        };
        let light = self.mesh.light(&light);
        if let Some(path) = &self.arguments.output {
            exposure = Exposure::MiddleGrey(self.write_picture(&light, exposure, path)?);
        }
        if let Some(path) = &self.arguments.gltf {
            let scene = &self.stage.space().scene;
            let (origin, up) = (scene.origin, self.arguments.view.up.unwrap_or(scene.up));
            let file = self.mesh.to_glb(&light, origin, up, exposure, self.tone());
            let (bytes, middle_grey) = file.map_err(Exit::failure)?;
            write(path, &bytes)?;
            exposure = Exposure::MiddleGrey(middle_grey);
        }
        let Exposure::MiddleGrey(radiosity) = exposure else { return Ok(when) };
        Ok(format!("{when}; middle grey is {} W/m²\n", decimal(radiosity, 4)))
    }

    /// Numbered pictures, all with the exposure of the last one.
    fn animation(&self, frames: u32, output: &Path) -> Result<String, Exit> {
        let mut paths = (1..=frames).map(|frame| numbered(output, frame, frames));
        paths.try_for_each(|path| lab::target(&path).map(drop)).map_err(Exit::bad_input)?;
        let (light, end) = self.light_at(&[Time::MAX])?;
        let exposure = self.exposure_of_end(&light[0])?;
        let times: Vec<Time> = (0..frames).map(|frame| part(end, frame, frames - 1)).collect();
        let mut frame = 0;
        for times in times.chunks(BATCH) {
            for light in self.light_at(times)?.0 {
                frame += 1;
                let path = numbered(output, frame, frames);
                self.write_picture(&self.mesh.light(&light), exposure, &path)?;
            }
        }
        let (end, last) = (seconds(end), numbered(output, frames, frames));
        Ok(format!("{frames} pictures until {end}, the last one is {}\n", last.display()))
    }

    /// The light of the run at these times, and the time of its end.
    fn light_at(&self, times: &[Time]) -> Result<(Vec<Light>, Time), Exit> {
        self.stage.light_at(times).map_err(Exit::failure)
    }

    /// The exposure for all instants of a run: that of its end.
    fn exposure_of_end(&self, light: &Light) -> Result<Exposure, Exit> {
        match self.exposure() {
            Exposure::Auto if self.arguments.output.is_some() => {
                let picture = self.picture(&self.mesh.light(light), Exposure::Auto)?;
                Ok(Exposure::MiddleGrey(picture.middle_grey))
            }
            exposure => Ok(exposure),
        }
    }

    fn picture(&self, light: &[Rgb], exposure: Exposure) -> Result<Picture, Exit> {
        let scene = &self.stage.space().scene;
        let View { up, eye, cut_above, .. } = self.arguments.view;
        let up = up.filter(|_| eye.is_none()).unwrap_or(scene.up);
        let cut_above = cut_above.map(|height| (up, height - scene.origin.dot(up)));
        let options = PictureOptions { exposure, tone: self.tone(), cut_above };
        let colour = |polygon, point| self.mesh.radiosity_at(light, polygon, point);
        render(scene, &self.camera, colour, options).map_err(Exit::bad_input)
    }

    /// Returns the radiosity that is shown as middle grey.
    fn write_picture(&self, light: &[Rgb], exposure: Exposure, path: &Path) -> Result<f64, Exit> {
        let picture = self.picture(light, exposure)?;
        let bytes = picture.encode_png().map_err(Exit::failure)?;
        write(path, &bytes)?;
        Ok(picture.middle_grey)
    }

    fn exposure(&self) -> Exposure {
        self.arguments.exposure.map_or(Exposure::Auto, Exposure::MiddleGrey)
    }

    fn tone(&self) -> Tone {
        match self.arguments.tone {
            ToneArgument::Reinhard => Tone::Reinhard,
            ToneArgument::Linear => Tone::Linear,
        }
    }
}

impl View {
    fn camera(&self, scene: &radiosity::Scene) -> Result<Camera, String> {
        let (width, height) = self.size;
        let up = self.up.unwrap_or(scene.up);
        let default = match self.camera {
            CameraArgument::Outside => Camera::overview(&scene.bounds, up, width, height),
            CameraArgument::Inside => Camera::inside(&scene.bounds, up, width, height),
        };
        let local = |place: Option<DVec3>| place.map(|place| place - scene.origin);
        let camera = Camera {
            eye: local(self.eye).unwrap_or(default.eye),
            target: local(self.target).unwrap_or(default.target),
            field_of_view_degrees: self.field_of_view.unwrap_or(default.field_of_view_degrees),
            ..default
        };
        if (camera.target - camera.eye).cross(camera.up).length_squared() > 0.0 {
            Ok(camera)
        } else {
            Err("--eye, --target, --up: eye and target are the same point, or up is parallel to the \
                 line of sight; expected two different directions"
                .to_owned())
        }
    }
}

/// The time at which `parts` of `of` equal parts of a run are over.
fn part(end: Time, parts: u32, of: u32) -> Time {
    let share = f64::from(parts) / f64::from(of);
    Time::ZERO + desim::Duration::from_seconds_f64(end.as_seconds_f64() * share)
}

fn seconds(time: Time) -> String {
    format!("{:.6} s", time.as_seconds_f64())
}

/// The file of a frame: its number has as many digits as the last frame's, at least three.
fn numbered(path: &Path, frame: u32, frames: u32) -> PathBuf {
    let digits = frames.to_string().len().max(3);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{frame:0digits$}.png"))
}

fn png(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_png = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
    if is_png { Ok(path) } else { Err("expected a file name that ends in .png".to_owned()) }
}

fn instant(text: &str) -> Result<Time, String> {
    let seconds = parse(text, Dimension::Time)?;
    Ok(Time::ZERO + desim::Duration::from_seconds_f64(seconds))
}

fn share(text: &str) -> Result<f64, String> {
    parse(text, Dimension::Fraction)
}

fn positive(text: &str) -> Result<f64, String> {
    let positive = number(text).ok().filter(|&number| number > 0.0);
    positive.ok_or_else(|| format!("found \"{text}\"; expected a number above zero"))
}

fn angle(text: &str) -> Result<f64, String> {
    let angle = number(text).ok().filter(|angle| (0.1..=179.0).contains(angle));
    angle.ok_or_else(|| format!("found \"{text}\"; expected degrees, 0.1 to 179"))
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let side = |text: &str| text.parse().ok().filter(|side| (1..=LARGEST_PICTURE).contains(side));
    let size = text.split_once('x').and_then(|(w, h)| Some((side(w)?, side(h)?)));
    size.ok_or_else(|| {
        format!(
            "found \"{text}\"; expected pixels, 1 to {LARGEST_PICTURE} either way, such as 1200x800"
        )
    })
}
