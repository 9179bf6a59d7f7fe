//! Values of arguments that several commands share.

use radiosity::glam::DVec3;

pub fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| format!("found \"{text}\"; expected a number"))
}

pub fn point(text: &str) -> Result<DVec3, String> {
    let numbers: Result<Vec<f64>, String> = text.split(',').map(number).collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) => Ok(DVec3::new(x, y, z)),
        _ => Err(format!("found \"{text}\"; expected three numbers, such as 1.5,-2,1.7")),
    }
}

/// A direction, as a unit vector: an axis, such as y or -z, or three numbers.
pub fn direction(text: &str) -> Result<DVec3, String> {
    let (name, sign) = text.strip_prefix('-').map_or((text, 1.0), |name| (name, -1.0));
    let axis = match name {
        "x" => Some(DVec3::X),
        "y" => Some(DVec3::Y),
        "z" => Some(DVec3::Z),
        _ => None,
    };
    if let Some(axis) = axis {
        return Ok(sign * axis);
    }
    let direction = point(text).ok().and_then(DVec3::try_normalize);
    direction.ok_or_else(|| {
        format!(
            "found \"{text}\"; expected an axis, such as y or -z, or three numbers, such as 0,1,0"
        )
    })
}
