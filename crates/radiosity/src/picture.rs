//! Pictures of a scene: a z-buffer finds what is seen, a function says how bright it is.

use std::fs;
use std::io;
use std::path::Path;

use glam::{DVec3, Vec3};

use crate::camera::Camera;
use crate::canvas::Canvas;
use crate::scene::{Rgb, Scene};

/// Samples along a pixel's side.
const FINENESS: usize = 2;

/// Most pixels along a side.
const LARGEST: u32 = 8192;

/// Brightness where nothing is seen, of 1.
const BACKGROUND: Rgb = Rgb::splat(0.012);

/// How radiosity becomes brightness.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Exposure {
    /// The geometric mean of what is seen becomes middle grey.
    #[default]
    Auto,
    /// This radiosity, W/m², becomes middle grey.
    MiddleGrey(f64),
}

/// What is shown, and how bright.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PictureOptions {
    /// How radiosity becomes brightness.
    pub exposure: Exposure,
    /// Leaves out everything above this height (z, local, metres): a look into one floor.
    pub cut_above: Option<f64>,
}

/// An RGB picture, eight bits a colour, sRGB.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Three bytes a pixel, rows from the top, from the left.
    pub rgb: Vec<u8>,
}

/// A picture of a size that cannot be made.
#[derive(Debug, thiserror::Error)]
#[error("picture of {width} x {height} pixels; expected 1 to {LARGEST} either way")]
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
    if !(1..=LARGEST).contains(&width) || !(1..=LARGEST).contains(&height) {
        return Err(PictureError { width, height });
    }
    let mut canvas = Canvas::new(camera, FINENESS);
    canvas.draw(scene, options.cut_above.unwrap_or(f64::INFINITY));
    let samples: Vec<Sample> = canvas
        .seen()
        .map(|seen| seen.map(|(polygon, point)| colour(polygon, point).as_vec3()))
        .collect();
    let middle = match options.exposure {
        Exposure::Auto => geometric_mean(&samples),
        Exposure::MiddleGrey(radiosity) => radiosity,
    };
    Ok(Picture { width, height, rgb: develop(&samples, width as usize, middle) })
}

/// Radiosity seen at a sample, if anything is.
type Sample = Option<Vec3>;

/// Middle grey of what is seen, W/m². What is all but black counts for a twentieth of the
/// mean, or rooms not lit yet would turn the others white.
fn geometric_mean(samples: &[Sample]) -> f64 {
    let seen = || samples.iter().flatten().map(|rgb| luminance(rgb.as_dvec3()));
    let count = seen().count().max(1) as f64;
    let least = 0.05 * seen().sum::<f64>() / count;
    if least > 0.0 {
        libm::exp(seen().map(|l| libm::log(l.max(least))).sum::<f64>() / count)
    } else {
        1.0
    }
}

/// Brightness to the eye (ITU-R BT.709).
fn luminance(rgb: Rgb) -> f64 {
    rgb.dot(Rgb::new(0.2126, 0.7152, 0.0722))
}

/// Averages the samples of each pixel and encodes them.
fn develop(samples: &[Sample], width: usize, middle: f64) -> Vec<u8> {
    let mut rgb = Vec::with_capacity(3 * samples.len() / (FINENESS * FINENESS));
    for rows in samples.chunks_exact(width * FINENESS * FINENESS) {
        for column in 0..width {
            let pixel: Rgb = rows
                .chunks_exact(width * FINENESS)
                .flat_map(|row| &row[column * FINENESS..][..FINENESS])
                .map(|sample| sample.map_or(BACKGROUND, |rgb| tone(rgb.as_dvec3() / middle)))
                .sum();
            rgb.extend((pixel / (FINENESS * FINENESS) as f64).to_array().map(srgb));
        }
    }
    rgb
}

/// From radiosity over middle grey to the screen's 0..1: Reinhard et al. 2002, equation 4, on the
/// luminance, so that colours stay what they are. Six times middle grey is white.
fn tone(relative: Rgb) -> Rgb {
    const KEY: f64 = 0.35;
    const WHITE: f64 = KEY * 6.0;
    let light = luminance(relative) * KEY;
    let scale = KEY * (1.0 + light / (WHITE * WHITE)) / (1.0 + light);
    (relative * scale).clamp(Rgb::ZERO, Rgb::ONE)
}

/// sRGB's transfer function, in eight bits.
fn srgb(linear: f64) -> u8 {
    let encoded = if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
    };
    (encoded * 255.0 + 0.5) as u8
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
