//! How a picture looks: camera, shading, exposure. The same arguments for every command that draws.

use clap::{Args, ValueEnum};
use radiosity::glam::DVec3;
use radiosity::{Camera, Exposure, LARGEST_PICTURE, PictureOptions, Scene, Shading, Tone};

use crate::arguments::{direction, number, point};
use crate::exit::Exit;

#[derive(Args)]
pub struct Look {
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
    /// Direction that is up in pictures and glTF files: an axis, such as y or -z, or three numbers
    /// [default: as the scene description says, else z]
    #[arg(long, value_name = "AXIS|X,Y,Z", value_parser = direction, allow_hyphen_values = true)]
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

impl Look {
    /// Pixels of a picture: width and height.
    pub fn size(&self) -> (u32, u32) {
        self.view.size
    }

    /// What is up in the picture of a scene, and in its glTF file.
    pub fn up(&self, scene: &Scene) -> DVec3 {
        self.view.up.unwrap_or(scene.up)
    }

    pub fn camera(&self, scene: &Scene) -> Result<Camera, Exit> {
        self.view.camera(scene).map_err(Exit::bad_input)
    }

    pub fn shading(&self) -> Shading {
        match self.shading {
            ShadingArgument::Smooth => Shading::Smooth,
            ShadingArgument::Flat => Shading::Flat,
        }
    }

    /// The exposure that is asked for, or the automatic one.
    pub fn exposure(&self) -> Exposure {
        self.exposure.map_or(Exposure::Auto, Exposure::MiddleGrey)
    }

    pub fn tone(&self) -> Tone {
        match self.tone {
            ToneArgument::Reinhard => Tone::Reinhard,
            ToneArgument::Linear => Tone::Linear,
        }
    }

    /// What a picture of a scene shows, with this exposure.
    pub fn options(&self, scene: &Scene, exposure: Exposure) -> PictureOptions {
        let View { up, eye, cut_above, .. } = self.view;
        let up = up.filter(|_| eye.is_none()).unwrap_or(scene.up);
        let cut_above = cut_above.map(|height| (up, height - scene.origin.dot(up)));
        PictureOptions { exposure, tone: self.tone(), cut_above }
    }
}

impl View {
    fn camera(&self, scene: &Scene) -> Result<Camera, String> {
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
