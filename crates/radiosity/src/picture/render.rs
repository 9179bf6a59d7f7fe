//! Pictures of a scene: a z-buffer finds what is seen, a function says how bright it is.

use std::fs;
use std::io;
use std::path::Path;

use glam::{DVec3, Vec3};

use super::camera::Camera;
use super::canvas::Canvas;
use super::tone::{Exposure, Tone, geometric_mean, srgb};
use crate::scene::{Rgb, Scene};

/// Samples along a pixel's side.
const FINENESS: usize = 2;

/// The most pixels that a picture may have along a side.
pub const LARGEST_PICTURE: u32 = 8192;

/// Brightness where nothing is seen, of 1.
const BACKGROUND: Rgb = Rgb::splat(0.012);

/// What is shown, and how bright.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PictureOptions {
    /// How radiosity becomes brightness.
    pub exposure: Exposure,
    /// How brightness nears white.
    pub tone: Tone,
    /// Leaves out everything above this height (z, local, metres): a look into one floor.
    pub cut_above: Option<f64>,
}

/// An RGB picture, eight bits a colour, sRGB.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Three bytes a pixel, rows from the top, from the left.
    pub rgb: Vec<u8>,
    /// The radiosity that became middle grey, W/m².
    pub middle_grey: f64,
}

/// A picture of a size that cannot be made.
#[derive(Debug, thiserror::Error)]
#[error("picture of {width} x {height} pixels; expected 1 to {LARGEST_PICTURE} either way")]
pub struct PictureError {
    width: u32,
    height: u32,
}

/// Draws what the camera sees. Polygons are seen from their fronts only, so that one looks through
/// the ceiling into a room as into a doll's house. `colour` gives the radiosity, W/m², of a polygon
/// (by its index) at a point (local coordinates).
///
/// # Errors
/// A picture without pixels or with more than 8192 along a side.
pub fn render(
    scene: &Scene,
    camera: &Camera,
    colour: impl Fn(u32, DVec3) -> Rgb,
    options: PictureOptions,
) -> Result<Picture, PictureError> {
    let (width, height) = (camera.width, camera.height);
    if !(1..=LARGEST_PICTURE).contains(&width) || !(1..=LARGEST_PICTURE).contains(&height) {
        return Err(PictureError { width, height });
    }
    let mut canvas = Canvas::new(camera, FINENESS);
    canvas.draw(scene, options.cut_above.unwrap_or(f64::INFINITY));
    let samples: Vec<Sample> = canvas
        .seen()
        .map(|seen| seen.map(|(polygon, point)| colour(polygon, point).as_vec3()))
        .collect();
    let middle_grey = match options.exposure {
        Exposure::Auto => {
            geometric_mean(&samples.iter().flatten().map(|rgb| (rgb.as_dvec3(), 1.0)))
        }
        Exposure::MiddleGrey(radiosity) => radiosity,
    };
    let shown = |rgb: Vec3| options.tone.map(rgb.as_dvec3() / middle_grey);
    let rgb = develop(&samples, width as usize, shown);
    Ok(Picture { width, height, rgb, middle_grey })
}

/// Radiosity seen at a sample, if anything is.
type Sample = Option<Vec3>;

/// Averages the samples of each pixel and encodes them.
fn develop(samples: &[Sample], width: usize, shown: impl Fn(Vec3) -> Rgb) -> Vec<u8> {
    let mut rgb = Vec::with_capacity(3 * samples.len() / (FINENESS * FINENESS));
    for rows in samples.chunks_exact(width * FINENESS * FINENESS) {
        for column in 0..width {
            let pixel: Rgb = rows
                .chunks_exact(width * FINENESS)
                .flat_map(|row| &row[column * FINENESS..][..FINENESS])
                .map(|sample| sample.map_or(BACKGROUND, &shown))
                .sum();
            rgb.extend((pixel / (FINENESS * FINENESS) as f64).to_array().map(srgb));
        }
    }
    rgb
}

/// Colours for a scene that is not solved: lights glow, all else is lit from above and the sides,
/// so that no two faces of a box look alike.
pub fn studio_light(scene: &Scene) -> impl Fn(u32, DVec3) -> Rgb {
    let sun = DVec3::new(0.45, -0.25, 0.8);
    move |polygon, _| {
        let polygon = &scene.polygons[polygon as usize];
        let material = scene.material(polygon);
        let glow = material.emission / material.emission.max_element().max(f64::MIN_POSITIVE);
        material.reflectance * (1.0 + 0.8 * polygon.plane.normal.dot(sun)) + glow * 8.0
    }
}

impl Picture {
    /// The picture as a PNG file's content.
    ///
    /// # Errors
    /// A picture whose bytes do not fit its size.
    pub fn encode_png(&self) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.rgb)?;
        writer.finish()?;
        Ok(bytes)
    }

    /// Writes the picture to a PNG file.
    ///
    /// # Errors
    /// As [`Picture::encode_png`], or a file that cannot be written.
    pub fn write_png(&self, path: &Path) -> io::Result<()> {
        fs::write(path, self.encode_png()?)
    }
}
