//! The text of a scene's files.

/// The text of the two files of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneText {
    /// Name of both files, without extension.
    pub name: String,
    /// The OBJ file. It refers to `<name>.mtl`.
    pub obj: String,
    /// The MTL file: reflectance in `Kd`, emitted radiosity in W/m² in `Ke`.
    pub mtl: String,
}
