//! The messages between processes, and their bytes.

use super::reader::{DecodeError, Reader};
use super::{source, wall_patch};
use crate::problem::Source;
use crate::walls::WallPatch;

/// A message between processes.
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
    /// A source and its mask for one environment of the receiver (§4.2.3).
    Source(Box<Source>),
    /// The energy of a wall patch, where virtual walls replace masks.
    WallPatch(Box<WallPatch>),
    /// Changes of radiosities by a shot, for the display (Figure 6, `send_to_host`).
    Update(Vec<PatchUpdate>),
    /// The service node asks for sums of energy.
    Collect,
    /// A compute node's answer.
    Sums(Sums),
    /// The service node tells compute nodes to select no more local patches (§4.2.4).
    StopSelecting,
    /// The token of the ring (§4.2.4).
    Token(bool),
    /// The computation has ended.
    Done,
}

/// One patch of an update.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchUpdate {
    /// Its environment.
    pub environment: u32,
    /// Its number there.
    pub patch: u32,
    /// By how much its radiosity has grown, W/m², in single precision as a display needs it.
    pub radiosity: [f32; 3],
}

/// What the service node collects from a compute node, W, summed over colours.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sums {
    /// The compute node.
    pub rank: u32,
    /// Unshot in its environments.
    pub unshot: f64,
    /// Sent so far.
    pub sent: f64,
    /// Taken from its queue and shot so far.
    pub taken: f64,
}

impl Message {
    /// The bytes that are sent, little-endian.
    pub fn encode(&self) -> Vec<u8> {
        let mut to = Vec::new();
        match self {
            Message::Source(source) => {
                to.push(0);
                source::encode(source, &mut to);
            }
            Message::Update(patches) => {
                to.reserve(1 + patches.len() * 20);
                to.push(1);
                for update in patches {
                    to.extend(update.environment.to_le_bytes());
                    to.extend(update.patch.to_le_bytes());
                    update.radiosity.iter().for_each(|x| to.extend(x.to_le_bytes()));
                }
            }
            Message::Collect => to.push(2),
            Message::Sums(sums) => {
                to.push(3);
                to.extend(sums.rank.to_le_bytes());
                for power in [sums.unshot, sums.sent, sums.taken] {
                    to.extend(power.to_le_bytes());
                }
            }
            Message::StopSelecting => to.push(4),
            Message::Token(value) => to.extend([5, u8::from(*value)]),
            Message::Done => to.push(6),
            Message::WallPatch(wall_patch) => {
                to.push(7);
                wall_patch::encode(wall_patch, &mut to);
            }
        }
        to
    }

    /// Decodes a message.
    pub fn decode(bytes: &[u8]) -> Result<Message, DecodeError> {
        let mut from = Reader(bytes);
        let message = match from.byte()? {
            0 => Message::Source(Box::new(source::decode(&mut from)?)),
            1 => {
                let mut patches = Vec::with_capacity(bytes.len() / 20);
                while !from.0.is_empty() {
                    patches.push(PatchUpdate {
                        environment: from.u32()?,
                        patch: from.u32()?,
                        radiosity: [from.f32()?, from.f32()?, from.f32()?],
                    });
                }
                Message::Update(patches)
            }
            2 => Message::Collect,
            3 => Message::Sums(Sums {
                rank: from.u32()?,
                unshot: from.f64()?,
                sent: from.f64()?,
                taken: from.f64()?,
            }),
            4 => Message::StopSelecting,
            5 => Message::Token(from.byte()? != 0),
            6 => Message::Done,
            7 => Message::WallPatch(Box::new(wall_patch::decode(&mut from)?)),
            _ => return Err(DecodeError("unknown kind")),
        };
        if from.0.is_empty() { Ok(message) } else { Err(DecodeError("bytes left over")) }
    }
}

#[cfg(test)]
mod tests {
    use radiosity::glam::DVec3;
    use radiosity::{DepthBits, Emitter, Mask};

    use super::*;

    fn source(pixels: u32) -> Message {
        let mut mask = Mask::none(pixels);
        (0..pixels).step_by(3).for_each(|i| mask.set(i));
        source_with(mask)
    }

    fn dimmed(pixels: u16, bits: DepthBits) -> Message {
        let steps = (0..pixels).map(|i| if i % 3 == 0 { bits.hidden() } else { i % 200 });
        source_with(Mask::from_steps(steps.collect(), bits).unwrap())
    }

    fn source_with(mask: Mask) -> Message {
        let emitter = Emitter {
            environment: 7,
            patch: 1_234,
            polygon: 99,
            centre: DVec3::new(0.1, -0.2, 1e6),
            normal: DVec3::Z,
            power: DVec3::new(1.0, 2.0, 3.5),
            radiosity: DVec3::new(10.0, 20.0, 35.0),
        };
        Message::Source(Box::new(Source {
            environment: 8,
            shot: 3,
            emitter,
            mask,
            form_factor: 0.25,
        }))
    }

    /// Every third bin is empty.
    fn wall_patch(bins: usize) -> Message {
        let power = (0..bins).map(|bin| [(bin % 3) as f32; 3]).collect();
        Message::WallPatch(Box::new(WallPatch { environment: 8, side: 5, patch: 77, power }))
    }

    #[test]
    fn every_message_comes_back_as_it_was() {
        let update =
            PatchUpdate { environment: 1, patch: 2, radiosity: [0.5, 0.25, f32::MIN_POSITIVE] };
        for message in [
            source(30_976),
            source(65),
            Message::Update(vec![update; 3]),
            Message::Update(vec![]),
            Message::Collect,
            Message::Sums(Sums { rank: 3, unshot: 1.0, sent: 2.0, taken: 0.1 }),
            Message::StopSelecting,
            Message::Token(true),
            Message::Token(false),
            Message::Done,
            dimmed(65, DepthBits::Eight),
            dimmed(65, DepthBits::Sixteen),
            wall_patch(1),
            wall_patch(65),
        ] {
            let bytes = message.encode();
            assert_eq!(Message::decode(&bytes).unwrap(), message);
        }
    }

    /// §4.2.3: "The message size is approximatively 4KBytes".
    #[test]
    fn a_source_of_the_default_hemisphere_takes_4_kb() {
        let bytes = source(30_976).encode().len();
        assert_eq!(bytes, 1 + 6 * 4 + 4 * 24 + 8 + 3_872);
        assert!(bytes <= 4_096);
        for (bits, more) in [(DepthBits::Eight, 30_976), (DepthBits::Sixteen, 2 * 30_976)] {
            assert_eq!(dimmed(30_976, bits).encode().len(), bytes - 3_872 + more);
        }
    }

    #[test]
    fn bytes_that_are_no_message_are_refused() {
        for whole in [source(65), wall_patch(65), dimmed(65, DepthBits::Sixteen)] {
            let whole = whole.encode();
            for length in 0..whole.len() {
                assert!(Message::decode(&whole[..length]).is_err(), "{length}");
            }
        }
        assert!(Message::decode(&[6, 6]).is_err());
        assert!(Message::decode(&[99]).is_err());
    }
}
