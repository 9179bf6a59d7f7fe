//! The bytes of a wall patch.

use super::reader::{DecodeError, Reader};
use crate::walls::WallPatch;

/// Append the bytes of a wall patch: a bit for each bin says whether it holds power; then follows the power of
/// the bins that do.
pub(super) fn encode(wall_patch: &WallPatch, to: &mut Vec<u8>) {
    let WallPatch { environment, side, patch, power } = wall_patch;
    to.extend(environment.to_le_bytes());
    to.push(*side);
    to.extend(patch.to_le_bytes());
    to.extend((power.len() as u16).to_le_bytes());
    for bins in power.chunks(8) {
        let held = bins.iter().zip(0..).map(|(&power, i)| u8::from(power != [0.0; 3]) << i);
        to.push(held.fold(0, |all, bit| all | bit));
    }
    let held = power.iter().filter(|&&power| power != [0.0; 3]);
    held.flatten().for_each(|x| to.extend(x.to_le_bytes()));
}

/// Decodes a wall patch.
pub(super) fn decode(from: &mut Reader) -> Result<WallPatch, DecodeError> {
    let (environment, side, patch) = (from.u32()?, from.byte()?, from.u32()?);
    let bins = usize::from(from.u16()?);
    let held = (0..bins.div_ceil(8)).map(|_| from.byte()).collect::<Result<Vec<u8>, _>>()?;
    let power = (0..bins).map(|bin| match held[bin / 8] >> (bin % 8) & 1 {
        0 => Ok([0.0; 3]),
        _ => Ok([from.f32()?, from.f32()?, from.f32()?]),
    });
    let power = power.collect::<Result<_, _>>()?;
    Ok(WallPatch { environment, side, patch, power })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 12 bytes for each bin that holds power, a bit for each that could, and 11.
    #[test]
    fn bytes_of_a_wall_patch() {
        for (bins, held) in [(1_usize, 0), (4, 2), (16, 10), (64, 42), (4_096, 2_730)] {
            let power = (0..bins).map(|bin| [(bin % 3) as f32; 3]).collect();
            let mut bytes = Vec::new();
            encode(&WallPatch { environment: 8, side: 5, patch: 77, power }, &mut bytes);
            assert_eq!(bytes.len(), 11 + bins.div_ceil(8) + held * 12, "{bins}");
        }
    }
}
