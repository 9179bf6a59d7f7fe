//! What travels where virtual walls stand in place of masks.

use crate::reader::{DecodeError, Reader};

/// A wall patch on its way to the environment behind it, which knows where it lies.
#[derive(Clone, Debug, PartialEq)]
pub struct WallPatch {
    /// Where it goes.
    pub environment: u32,
    /// The side of that environment by which light enters, by [`Side::index`](radiosity::Side::index).
    pub side: u8,
    /// The wall patch of that side.
    pub patch: u32,
    /// Power in each bin of directions, W.
    pub power: Vec<[f32; 3]>,
}

impl WallPatch {
    /// Words of 8 bytes that its bins take.
    pub(crate) fn words(&self) -> u64 {
        (self.power.len() as u64 * 12).div_ceil(8)
    }

    /// A bit a bin tells whether it holds power; only the power of those that do follows.
    pub(crate) fn encode(&self, to: &mut Vec<u8>) {
        let WallPatch { environment, side, patch, power } = self;
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

    /// What bytes stand for.
    pub(crate) fn decode(from: &mut Reader) -> Result<WallPatch, DecodeError> {
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
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 12 bytes for each bin that holds power, a bit for each that could, and 11.
    #[test]
    fn a_wall_patch_takes_what_its_bins_take() {
        for (bins, held) in [(1_usize, 0), (4, 2), (16, 10), (64, 42), (4_096, 2_730)] {
            let power = (0..bins).map(|bin| [(bin % 3) as f32; 3]).collect();
            let mut bytes = Vec::new();
            WallPatch { environment: 8, side: 5, patch: 77, power }.encode(&mut bytes);
            assert_eq!(bytes.len(), 11 + bins.div_ceil(8) + held * 12, "{bins}");
        }
    }
}
