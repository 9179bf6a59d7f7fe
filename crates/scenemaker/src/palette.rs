//! Materials. Reflectances are typical for each surface: white ceilings 0.75 to 0.8, painted walls
//! 0.5 to 0.7, floors 0.2 to 0.4, wood and cloth 0.2 to 0.5. Windows are nearly black, as at night.

use std::fmt;

/// Reflectance and emission of a surface.
pub struct Material {
    /// Name in the MTL file.
    pub name: &'static str,
    /// Reflectance, red, green, blue.
    pub kd: [f64; 3],
    /// Emitted radiosity, W/m², red, green, blue.
    pub ke: [f64; 3],
}

impl fmt::Display for Material {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [r, g, b] = self.kd;
        writeln!(f, "newmtl {}\nKd {r} {g} {b}", self.name)?;
        match self.ke {
            [0.0, 0.0, 0.0] => Ok(()),
            [r, g, b] => writeln!(f, "Ke {r} {g} {b}"),
        }
    }
}

macro_rules! materials {
    ($($ident:ident $name:literal [$r:literal, $g:literal, $b:literal])*) => {
        $(pub static $ident: Material =
            Material { name: $name, kd: [$r, $g, $b], ke: [0.0; 3] };)*
    };
}

/// A ceiling panel, slightly warm.
pub static LIGHT: Material = Material { name: "light", kd: [0.7; 3], ke: [640.0, 600.0, 530.0] };

/// The light of the Cornell box. Its colours and those of the walls are the values that renderers
/// commonly derive from the published spectra.
pub static BOX_LIGHT: Material =
    Material { name: "box_light", kd: [0.78; 3], ke: [17.0, 12.0, 4.0] };

materials! {
    BOX_WHITE "white" [0.725, 0.71, 0.68]
    BOX_RED "box_red" [0.63, 0.065, 0.05]
    BOX_GREEN "box_green" [0.14, 0.45, 0.091]
    CEILING "ceiling" [0.78, 0.78, 0.76]
    WALL "wall" [0.66, 0.64, 0.58]
    WARM_WALL "warm_wall" [0.68, 0.58, 0.45]
    BLUE_WALL "blue_wall" [0.50, 0.58, 0.66]
    GREEN_WALL "green_wall" [0.55, 0.64, 0.52]
    BRICK "brick" [0.68, 0.48, 0.38]
    FRAME "frame" [0.62, 0.60, 0.56]
    DOOR "door" [0.50, 0.32, 0.18]
    GLASS "glass" [0.06, 0.08, 0.12]
    CARPET "carpet" [0.24, 0.28, 0.34]
    WOOD_FLOOR "wood_floor" [0.42, 0.30, 0.19]
    STONE "stone" [0.40, 0.38, 0.34]
    CONCRETE "concrete" [0.45, 0.45, 0.44]
    WOOD "wood" [0.55, 0.42, 0.27]
    DARK_WOOD "dark_wood" [0.40, 0.28, 0.18]
    METAL "metal" [0.35, 0.36, 0.38]
    RED "red" [0.55, 0.16, 0.12]
    BLUE "blue" [0.16, 0.27, 0.52]
    GREEN "green" [0.22, 0.44, 0.24]
    YELLOW "yellow" [0.62, 0.50, 0.16]
}
