//! Writes the three scenes into a folder: `write_scenes FOLDER [SEED]`, seed 1996 by default.

use std::{env, error::Error, fs, path::PathBuf};

use scenemaker::SceneKind;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let folder = PathBuf::from(arguments.next().ok_or("which folder?")?);
    let seed = arguments.next().map_or(Ok(1996), |text| text.parse())?;
    for kind in SceneKind::ALL {
        let scene = scenemaker::make(kind, seed);
        fs::write(folder.join(format!("{kind}.obj")), scene.obj)?;
        fs::write(folder.join(format!("{kind}.mtl")), scene.mtl)?;
    }
    Ok(())
}
