//! The wire format of everything that processes send.

use radiosity::{DepthBits, Emitter, Mask};

use crate::reader::{DecodeError, Reader};
use crate::wall_patch::WallPatch;

/// A message between processes.
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
    /// A source and its mask for one environment of the receiver (§4.2.3).
    Source(Box<Source>),
    /// What a wall patch has gathered, where virtual walls stand in place of masks.
    WallPatch(Box<WallPatch>),
    /// Radiosities of patches that a shot changed, for the display (Figure 6, `send_to_host`).
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

/// A source on its way to an environment.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Where it goes.
    pub environment: u32,
    /// Geometry and photometry of the emitter.
    pub emitter: Emitter,
    /// The pixels that arrive.
    pub mask: Mask,
    /// The sum of their form factors.
    pub form_factor: f64,
}

impl Source {
    /// Whether the emitter lies in the environment that the source is shot in. What has left an
    /// environment never comes back: it is a box, and rays are straight.
    pub fn is_local(&self) -> bool {
        self.environment == self.emitter.environment
    }
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
    /// Who answers.
    pub rank: u32,
    /// Unshot in its environments.
    pub unshot: f64,
    /// Sent so far.
    pub sent: f64,
    /// Taken from its queue and shot so far.
    pub taken: f64,
}

impl Message {
    /// The bytes that travel, little-endian.
    pub fn encode(&self) -> Vec<u8> {
        let mut to = Vec::new();
        match self {
            Message::Source(parcel) => {
                let Source { mask, .. } = &**parcel;
                to.reserve(160 + (mask.pixels() * mask.bits_a_pixel() / 8) as usize);
                to.push(0);
                encode_parcel(parcel, &mut to);
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
                wall_patch.encode(&mut to);
            }
        }
        to
    }

    /// The message that bytes stand for.
    pub fn decode(bytes: &[u8]) -> Result<Message, DecodeError> {
        let mut from = Reader(bytes);
        let message = match from.byte()? {
            0 => Message::Source(Box::new(decode_parcel(&mut from)?)),
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
            7 => Message::WallPatch(Box::new(WallPatch::decode(&mut from)?)),
            _ => return Err(DecodeError("unknown kind")),
        };
        if from.0.is_empty() { Ok(message) } else { Err(DecodeError("bytes left over")) }
    }
}

/// Bits of a message that hold the number of pixels; [`radiosity::MOST_PIXELS`] fits them.
const PIXEL_BITS: u32 = 25;

/// Sizes of the integers that travel where there are media.
const DEPTHS: [DepthBits; 2] = [DepthBits::Eight, DepthBits::Sixteen];

/// How a mask is sent: a bit a pixel, or an integer of 8 or 16 bits a pixel.
fn layout(mask: &Mask) -> u32 {
    match mask.depth_bits() {
        None => 0,
        Some(DepthBits::Eight) => 1,
        Some(DepthBits::Sixteen) => 2,
    }
}

fn encode_parcel(parcel: &Source, to: &mut Vec<u8>) {
    let Source { environment, emitter: source, mask, form_factor } = parcel;
    let pixels = mask.pixels() | layout(mask) << PIXEL_BITS;
    let numbers = [*environment, source.environment, source.patch, source.polygon, pixels];
    numbers.iter().for_each(|n| to.extend(n.to_le_bytes()));
    for vector in [source.centre, source.normal, source.power, source.radiosity] {
        vector.to_array().iter().for_each(|x| to.extend(x.to_le_bytes()));
    }
    to.extend(form_factor.to_le_bytes());
    match mask.steps() {
        None => encode_words(mask.words(), to),
        Some((steps, DepthBits::Eight)) => to.extend(steps.iter().map(|&steps| steps as u8)),
        Some((steps, DepthBits::Sixteen)) => {
            steps.iter().for_each(|steps| to.extend(steps.to_le_bytes()));
        }
    }
}

fn encode_words(words: &[u64], to: &mut Vec<u8>) {
    let start = to.len();
    to.resize(start + words.len() * 8, 0);
    for (place, word) in to[start..].chunks_exact_mut(8).zip(words) {
        place.copy_from_slice(&word.to_le_bytes());
    }
}

fn decode_parcel(from: &mut Reader) -> Result<Source, DecodeError> {
    let (environment, source_environment) = (from.u32()?, from.u32()?);
    let (patch, polygon, pixels) = (from.u32()?, from.u32()?, from.u32()?);
    let source = Emitter {
        environment: source_environment,
        patch,
        polygon,
        centre: from.vector()?,
        normal: from.vector()?,
        power: from.vector()?,
        radiosity: from.vector()?,
    };
    let form_factor = from.f64()?;
    let (pixels, layout) = (pixels & ((1 << PIXEL_BITS) - 1), pixels >> PIXEL_BITS);
    let mask = decode_mask(std::mem::take(&mut from.0), pixels, layout)?;
    Ok(Source { environment, emitter: source, mask, form_factor })
}

/// A mask from what has travelled, with its pixels and its layout.
fn decode_mask(from: &[u8], pixels: u32, layout: u32) -> Result<Mask, DecodeError> {
    let mask = match layout.checked_sub(1).map(|i| DEPTHS.get(i as usize)) {
        Some(None) => None,
        Some(Some(&bits)) => {
            let steps = from.chunks(bits.bits() as usize / 8).map(|chunk| match chunk {
                &[steps] if bits == DepthBits::Eight => Ok(u16::from(steps)),
                chunk => Reader(chunk).u16(),
            });
            Mask::from_steps(steps.collect::<Result<_, _>>()?, bits)
                .filter(|mask| mask.pixels() == pixels)
        }
        None => {
            let (words, rest) = from.as_chunks();
            let words = words.iter().map(|&word| u64::from_le_bytes(word)).collect();
            Mask::from_words(words, pixels).filter(|_| rest.is_empty())
        }
    };
    mask.ok_or(DecodeError("mask and pixels differ"))
}

#[cfg(test)]
mod tests {
    use radiosity::glam::DVec3;

    use super::*;
    use crate::message_kind::MessageKind;

    fn parcel(pixels: u32) -> Message {
        let mut mask = Mask::none(pixels);
        (0..pixels).step_by(3).for_each(|i| mask.set(i));
        parcel_with(mask)
    }

    fn dimmed(pixels: u16, bits: DepthBits) -> Message {
        let steps = (0..pixels).map(|i| if i % 3 == 0 { bits.hidden() } else { i % 200 });
        parcel_with(Mask::from_steps(steps.collect(), bits).unwrap())
    }

    fn parcel_with(mask: Mask) -> Message {
        let source = Emitter {
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
            emitter: source,
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
            parcel(30_976),
            parcel(65),
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
            assert!(kinds_match(&message, MessageKind::of(&bytes).unwrap()));
        }
    }

    fn kinds_match(message: &Message, kind: MessageKind) -> bool {
        match message {
            Message::Source(_) => kind == MessageKind::Source,
            Message::Update(_) => kind == MessageKind::Update,
            Message::Collect => kind == MessageKind::Collect,
            Message::Sums(_) => kind == MessageKind::Sums,
            Message::StopSelecting => kind == MessageKind::StopSelecting,
            Message::Token(_) => kind == MessageKind::Token,
            Message::Done => kind == MessageKind::Done,
            Message::WallPatch(_) => kind == MessageKind::WallPatch,
        }
    }

    /// §4.2.3: "The message size is approximatively 4KBytes".
    #[test]
    fn a_source_of_the_default_hemisphere_takes_4_kb() {
        let bytes = parcel(30_976).encode().len();
        assert_eq!(bytes, 1 + 5 * 4 + 4 * 24 + 8 + 3_872);
        assert!(bytes <= 4_096);
        for (bits, more) in [(DepthBits::Eight, 30_976), (DepthBits::Sixteen, 2 * 30_976)] {
            assert_eq!(dimmed(30_976, bits).encode().len(), bytes - 3_872 + more);
        }
    }

    #[test]
    fn bytes_that_are_no_message_are_refused() {
        for whole in [parcel(65), wall_patch(65), dimmed(65, DepthBits::Sixteen)] {
            let whole = whole.encode();
            for length in 0..whole.len() {
                assert!(Message::decode(&whole[..length]).is_err(), "{length}");
            }
        }
        assert!(Message::decode(&[6, 6]).is_err());
        assert!(Message::decode(&[99]).is_err());
    }
}
