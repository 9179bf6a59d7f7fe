//! Pictures of a scene, drawn with a z-buffer, and their PNG files.

use std::io;

use glam::{DQuat, DVec3, Vec3};

use super::camera::Camera;
use super::tone::{Exposure, Tone, geometric_mean, srgb};
use super::z_buffer::ZBuffer;
use crate::scene::{Rgb, Scene};

/// Number of samples along a side of a pixel.
const SAMPLES: usize = 2;

/// Largest number of pixels along a side of a picture.
pub const LARGEST_PICTURE: u32 = 8192;

/// Brightness of the background, 0 to 1.
const BACKGROUND: Rgb = Rgb::splat(0.012);

/// What is shown, and with which exposure.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PictureOptions {
    /// How radiosity is scaled to brightness.
    pub exposure: Exposure,
    /// How brightness is limited to white.
    pub tone: Tone,
    /// Omits everything above this local height, metres, along a unit vector, to show one floor.
    pub cut_above: Option<(DVec3, f64)>,
}

/// An sRGB picture with eight bits per component.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Three bytes per pixel, rows from top to bottom, from left to right.
    pub rgb: Vec<u8>,
    /// The radiosity shown as middle grey, W/m².
    pub middle_grey: f64,
}

/// Why a picture or a mesh cannot be drawn.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub enum PictureError {
    /// A picture size that is not possible.
    #[error("picture of {width} x {height} pixels; expected 1 to {LARGEST_PICTURE} either way")]
    Size {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// A radiosity that is NaN, or that a number of 32 bits cannot hold.
    #[error("a radiosity that is not finite; expected less than 3e38 W/m²")]
    NotFinite,
}

/// Checks that radiosities, and the one that is shown as middle grey, are finite in 32 bits.
pub(crate) fn check_finite(
    mut light: impl Iterator<Item = Vec3>,
    middle_grey: f64,
) -> Result<(), PictureError> {
    let finite = light.all(|rgb| rgb.is_finite()) && middle_grey.is_finite();
    if finite { Ok(()) } else { Err(PictureError::NotFinite) }
}

/// Draws what the camera sees.
///
/// Only fronts are visible, so that a camera above a room sees through its ceiling. `colour`
/// returns the radiosity, W/m², of a polygon (by index) at a point (local coordinates).
///
/// # Errors
/// A picture without pixels or with more than 8192 pixels along a side, or a radiosity that is not finite.
pub fn render(
    scene: &Scene,
    camera: &Camera,
    colour: impl Fn(u32, DVec3) -> Rgb,
    options: PictureOptions,
) -> Result<Picture, PictureError> {
    let (width, height) = (camera.width, camera.height);
    if !(1..=LARGEST_PICTURE).contains(&width) || !(1..=LARGEST_PICTURE).contains(&height) {
        return Err(PictureError::Size { width, height });
    }
    let mut buffer = ZBuffer::new(camera, SAMPLES);
    let (up, highest) = options.cut_above.unwrap_or((DVec3::Z, f64::INFINITY));
    buffer.draw(scene, up, highest);
    let samples: Vec<Sample> = buffer
        .seen()
        .map(|seen| seen.map(|(polygon, point)| colour(polygon, point).as_vec3()))
        .collect();
    let middle_grey = match options.exposure {
        Exposure::Auto => {
            geometric_mean(&samples.iter().flatten().map(|rgb| (rgb.as_dvec3(), 1.0)))
        }
        Exposure::MiddleGrey(radiosity) => radiosity,
    };
    check_finite(samples.iter().flatten().copied(), middle_grey)?;
    let shown = |rgb: Vec3| options.tone.map(rgb.as_dvec3() / middle_grey);
    let rgb = encode_pixels(&samples, width as usize, shown);
    Ok(Picture { width, height, rgb, middle_grey })
}

/// Visible radiosity at a sample, or `None` for the background.
type Sample = Option<Vec3>;

/// Averages the samples of each pixel and encodes the pixels in sRGB.
fn encode_pixels(samples: &[Sample], width: usize, shown: impl Fn(Vec3) -> Rgb) -> Vec<u8> {
    let mut rgb = Vec::with_capacity(3 * samples.len() / (SAMPLES * SAMPLES));
    for rows in samples.chunks_exact(width * SAMPLES * SAMPLES) {
        for column in 0..width {
            let pixel: Rgb = rows
                .chunks_exact(width * SAMPLES)
                .flat_map(|row| &row[column * SAMPLES..][..SAMPLES])
                .map(|sample| sample.map_or(BACKGROUND, &shown))
                .sum();
            rgb.extend((pixel / (SAMPLES * SAMPLES) as f64).to_array().map(srgb));
        }
    }
    rgb
}

/// Simple lighting for a scene without a solution: lights glow, and all other surfaces are shaded
/// by their orientation, so that the faces of a box differ. `up` is a unit vector.
pub fn studio_light(scene: &Scene, up: DVec3) -> impl Fn(u32, DVec3) -> Rgb {
    let sun = DQuat::from_rotation_arc(DVec3::Z, up) * DVec3::new(0.45, -0.25, 0.8);
    move |polygon, _| {
        let polygon = &scene.polygons[polygon as usize];
        let material = scene.material(polygon);
        let glow = material.emission / material.emission.max_element().max(f64::MIN_POSITIVE);
        material.reflectance * (1.0 + 0.8 * polygon.plane.normal.dot(sun)) + glow * 8.0
    }
}

impl Picture {
    /// The content of a PNG file of the picture.
    ///
    /// # Errors
    /// A picture whose number of bytes does not match its size.
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
}
