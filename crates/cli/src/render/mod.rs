//! `virtwall render`: draws a scene, or any instant of a run, as a picture, an animation or a glTF file.

mod look;

use std::path::{Path, PathBuf};

use clap::Args;
use config::{Dimension, decimal, parse, short_name};
use desim::Time;
use lab::{Light, Solved, Stage, StagedRun, Which};
use radiosity::{Camera, Exposure, Mesh, Picture, Rgb, render};

pub use self::look::Look;
use crate::exit::{Exit, print_note, print_warnings};
use crate::files::{check_writable, write};
use crate::steps::Steps;

/// The most frames whose light is in memory at one time.
const BATCH: usize = 32;

/// The share of the light of a scene that may be unshot, by default.
const UNSHOT: f64 = 0.1;

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
    look: Look,
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
    /// Virtual time, such as "3.2 s" [default: the end, which is also shown for later times]
    #[arg(long, value_name = "TIME", value_parser = instant)]
    at: Option<Time>,
    /// Draw N pictures at equal intervals from the start to the end, as PNG-001.png and so on
    #[arg(long, value_name = "N", conflicts_with = "at", requires = "output")]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=10_000))]
    frames: Option<u32>,
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
    let (width, height) = arguments.look.size();
    let renderer = Renderer::new(&stage, &arguments.look)?;
    let drawn = match (&stage.run, frames, &arguments.output) {
        (Some(_), Some(frames), Some(output)) => renderer.animation(*frames, output)?,
        (Some(run), ..) => renderer.instant(run, arguments)?,
        (None, ..) => renderer.solution(arguments)?,
    };
    let text = format!("{}\n{drawn}", short_name(&stage.title));
    Ok(if arguments.output.is_some() {
        text + &format!("{width} x {height} pixels\n")
    } else {
        text
    })
}

/// Draws the solution of a scene as `virtwall render` does by default; returns how far it is solved.
pub fn draw_solution(stage: &Stage, look: &Look, path: &Path) -> Result<String, Exit> {
    let renderer = Renderer::new(stage, look)?;
    let solved = solved(stage, UNSHOT);
    renderer.write_picture(&renderer.mesh.light(&solved.light), look.exposure(), path)?;
    Ok(left(&solved))
}

/// The light of a scene; warns if more is left than what was asked for.
fn solved(stage: &Stage, unshot: f64) -> Solved {
    let (steps, watch) = Steps::of_light(unshot);
    let solved = stage.solved(unshot, watch);
    steps.end();
    solved.warning(unshot).iter().for_each(|warning| print_note(&format!("warning: {warning}")));
    solved
}

fn left(Solved { left, shots, .. }: &Solved) -> String {
    format!("{:.1} % of the light unshot after {shots} shots", 100.0 * left)
}

struct Renderer<'a> {
    look: &'a Look,
    stage: &'a Stage,
    mesh: Mesh<'a>,
    camera: Camera,
}

impl<'a> Renderer<'a> {
    fn new(stage: &'a Stage, look: &'a Look) -> Result<Renderer<'a>, Exit> {
        let camera = look.camera(&stage.space().scene)?;
        let mesh = Mesh::new(stage.space(), stage.environments(), look.shading());
        Ok(Renderer { look, stage, mesh, camera })
    }

    fn solution(&self, arguments: &Arguments) -> Result<String, Exit> {
        let solved = solved(self.stage, arguments.moment.unshot);
        self.still(&solved.light, self.look.exposure(), arguments, left(&solved))
    }

    fn instant(&self, run: &StagedRun, arguments: &Arguments) -> Result<String, Exit> {
        let at = arguments.moment.at.unwrap_or(Time::MAX);
        let (light, end) = self.light_at(&[at, Time::MAX])?;
        let row = run.row;
        let when = match arguments.moment.at {
            Some(at) if at > end => {
                let (at, end) = (seconds(at), seconds(end));
                format!("run {row} at its end, {end}, since --at {at} is later")
            }
            _ => format!("run {row} at {} of {}", seconds(at.min(end)), seconds(end)),
        };
        let exposure = match &arguments.output {
            Some(_) => self.exposure_of(&light[1])?,
            None => self.look.exposure(),
        };
        self.still(&light[0], exposure, arguments, when)
    }

    /// Writes a picture and a glTF file, as the arguments say, of the light at one time.
    fn still(
        &self,
        light: &Light,
        mut exposure: Exposure,
        arguments: &Arguments,
        when: String,
    ) -> Result<String, Exit> {
        let light = self.mesh.light(light);
        if let Some(path) = &arguments.output {
            exposure = Exposure::MiddleGrey(self.write_picture(&light, exposure, path)?);
        }
        if let Some(path) = &arguments.gltf {
            let scene = &self.stage.space().scene;
            let (origin, up) = (scene.origin, self.look.up(scene));
            let file = self.mesh.to_glb(&light, origin, up, exposure, self.look.tone());
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
        let exposure = self.exposure_of(&light[0])?;
        let times: Vec<Time> = (0..frames).map(|frame| part(end, frame, frames - 1)).collect();
        let steps = Steps::new("pictures", frames as usize);
        let mut frame = 0;
        for times in times.chunks(BATCH) {
            for light in self.stage.light_at(times, || ()).map_err(Exit::failure)?.0 {
                frame += 1;
                let path = numbered(output, frame, frames);
                self.write_picture(&self.mesh.light(&light), exposure, &path)?;
                steps.one();
            }
        }
        steps.end();
        let (end, last) = (seconds(end), numbered(output, frames, frames));
        Ok(format!("{frames} pictures until {end}, the last one is {}\n", last.display()))
    }

    /// The light of the run at these times, and the time of its end.
    fn light_at(&self, times: &[Time]) -> Result<(Vec<Light>, Time), Exit> {
        let steps = Steps::of_shots();
        let found = self.stage.light_at(times, steps.counter());
        steps.end();
        found.map_err(Exit::failure)
    }

    /// The exposure that is asked for, else that of the picture of this light.
    fn exposure_of(&self, light: &Light) -> Result<Exposure, Exit> {
        match self.look.exposure() {
            Exposure::Auto => {
                let picture = self.picture(&self.mesh.light(light), Exposure::Auto)?;
                Ok(Exposure::MiddleGrey(picture.middle_grey))
            }
            exposure => Ok(exposure),
        }
    }

    fn picture(&self, light: &[Rgb], exposure: Exposure) -> Result<Picture, Exit> {
        let scene = &self.stage.space().scene;
        let colour = |polygon, point| self.mesh.radiosity_at(light, polygon, point);
        let options = self.look.options(scene, exposure);
        render(scene, &self.camera, colour, options).map_err(Exit::bad_input)
    }

    /// Returns the radiosity that is shown as middle grey.
    fn write_picture(&self, light: &[Rgb], exposure: Exposure, path: &Path) -> Result<f64, Exit> {
        let picture = self.picture(light, exposure)?;
        let bytes = picture.encode_png().map_err(Exit::failure)?;
        write(path, &bytes)?;
        Ok(picture.middle_grey)
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
