//! Binary glTF 2.0 files of meshes: <https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html>

use glam::{DQuat, DVec3};
use serde_json::{Value, json};

use super::render::{PictureError, check_finite};
use super::tone::{Exposure, Tone, geometric_mean};
use super::triangles::Mesh;
use crate::geometry::Bounds;
use crate::scene::Rgb;

/// Constants of the specification.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

impl Mesh<'_> {
    /// A binary glTF file of the mesh with radiosity `light`, W/m², at its vertices and the origin
    /// of the scene at `origin`, metres. Also returns the radiosity shown as middle grey. The file
    /// contains a rotation of `up`, a unit vector, to y, which is the upward axis in glTF.
    ///
    /// Vertices have the attributes `COLOR_0`, the linear brightness that a picture with this
    /// exposure and tone would show (viewers apply the sRGB transfer function), and `_RADIOSITY`,
    /// W/m². Viewers do not light the material again (`KHR_materials_unlit`).
    ///
    /// # Errors
    /// A radiosity that is not finite.
    pub fn to_glb(
        &self,
        light: &[Rgb],
        origin: DVec3,
        up: DVec3,
        exposure: Exposure,
        tone: Tone,
    ) -> Result<(Vec<u8>, f64), PictureError> {
        let middle_grey = match exposure {
            Exposure::Auto => self.middle_grey(light),
            Exposure::MiddleGrey(radiosity) => radiosity,
        };
        check_finite(light.iter().map(|rgb| rgb.as_vec3()), middle_grey)?;
        let mut file = File::default();
        let positions = self.positions();
        let bounds = Bounds::of(positions.iter().copied());
        // Rounded to 32 bits exactly as in the file.
        let [low, high] =
            [bounds.min, bounds.max].map(|v| json!(v.as_vec3().as_dvec3().to_array()));
        let position = file.vectors(positions.iter().copied());
        (file.accessors[position]["min"], file.accessors[position]["max"]) = (low, high);
        let attributes = json!({
            "POSITION": position,
            "NORMAL": file.vectors(self.normals().iter().copied()),
            "COLOR_0": file.vectors(light.iter().map(|&rgb| tone.map(rgb / middle_grey))),
            "_RADIOSITY": file.vectors(light.iter().copied()),
        });
        let indices = file.indices(self.triangles().flatten());
        let primitive = json!({ "attributes": attributes, "indices": indices, "material": 0 });
        let nodes = json!([
            { "rotation": to_y(up), "children": [1] },
            { "translation": origin.to_array(), "mesh": 0 },
        ]);
        Ok((file.whole(&primitive, &nodes, middle_grey), middle_grey))
    }

    /// Middle grey of all triangles, weighted by area, W/m².
    fn middle_grey(&self, light: &[Rgb]) -> f64 {
        let of_triangle = |triangle: [u32; 3]| {
            let [a, b, c] = triangle.map(|vertex| self.positions()[vertex as usize]);
            let rgb = triangle.map(|vertex| light[vertex as usize]).iter().sum::<Rgb>() / 3.0;
            (rgb, (b - a).cross(c - a).length())
        };
        let seen: Vec<(Rgb, f64)> = self.triangles().map(of_triangle).collect();
        geometric_mean(&seen.iter().copied())
    }
}

/// The rotation of a unit vector to y, as a quaternion.
fn to_y(up: DVec3) -> [f64; 4] {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    match up {
        DVec3::Z => [-half, 0.0, 0.0, half],
        up => DQuat::from_rotation_arc(up, DVec3::Y).normalize().to_array(),
    }
}

/// A glTF file: its binary data, and the description of the data.
#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl File {
    /// Adds one vector per vertex and returns the index of their accessor.
    fn vectors(&mut self, vectors: impl Iterator<Item = DVec3>) -> usize {
        let start = self.bytes.len();
        let numbers = vectors.flat_map(|vector| vector.as_vec3().to_array());
        self.bytes.extend(numbers.flat_map(f32::to_le_bytes));
        let count = (self.bytes.len() - start) / 12;
        self.accessor(start, ARRAY_BUFFER, json!({ "componentType": FLOAT, "type": "VEC3" }), count)
    }

    /// Adds vertex indices and returns the index of their accessor.
    fn indices(&mut self, vertices: impl Iterator<Item = u32>) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(vertices.flat_map(u32::to_le_bytes));
        let count = (self.bytes.len() - start) / 4;
        let kind = json!({ "componentType": UNSIGNED_INT, "type": "SCALAR" });
        self.accessor(start, ELEMENT_ARRAY_BUFFER, kind, count)
    }

    /// Describes the bytes from `start` on, and returns the index of the accessor.
    fn accessor(&mut self, start: usize, target: u32, mut kind: Value, count: usize) -> usize {
        let length = self.bytes.len() - start;
        self.views.push(json!({
            "buffer": 0, "byteOffset": start, "byteLength": length, "target": target,
        }));
        kind["bufferView"] = json!(self.views.len() - 1);
        kind["count"] = json!(count);
        self.accessors.push(kind);
        self.accessors.len() - 1
    }

    /// The whole file: a header, a JSON chunk, a binary chunk.
    fn whole(mut self, primitive: &Value, nodes: &Value, middle_grey: f64) -> Vec<u8> {
        let json = json!({
            "asset": {
                "version": "2.0",
                "generator": concat!("virtwall ", env!("CARGO_PKG_VERSION")),
                "extras": { "middle_grey_w_per_m2": middle_grey },
            },
            "extensionsUsed": ["KHR_materials_unlit"],
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": nodes,
            "meshes": [{ "primitives": [primitive] }],
            "materials": [{
                "pbrMetallicRoughness": { "metallicFactor": 0.0 },
                "extensions": { "KHR_materials_unlit": {} },
            }],
            "buffers": [{ "byteLength": self.bytes.len() }],
            "bufferViews": self.views,
            "accessors": self.accessors,
        });
        let mut text = json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let chunks = [(b"JSON", text), (b"BIN\0", self.bytes)];
        let length = 12 + chunks.iter().map(|(_, bytes)| 8 + bytes.len()).sum::<usize>();
        let mut file = b"glTF".to_vec();
        file.extend(2_u32.to_le_bytes());
        file.extend((length as u32).to_le_bytes());
        for (kind, bytes) in chunks {
            file.extend((bytes.len() as u32).to_le_bytes());
            file.extend(kind);
            file.extend(bytes);
        }
        file
    }
}
