//! The wire format of everything that processes send.

use radiosity::glam::DVec3;
use radiosity::{Mask, Source};
use thiserror::Error;

/// A message between processes.
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
    /// A source and its mask for one environment of the receiver (§4.2.3).
    Source(Box<Parcel>),
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
pub struct Parcel {
    /// Where it goes.
    pub environment: u32,
    /// Geometry and photometry of the emitter.
    pub source: Source,
    /// The pixels that arrive.
    pub mask: Mask,
    /// Their form factor together.
    pub form_factor: f64,
}

impl Parcel {
    /// Whether the emitter lies in the environment that the source is shot in. What has left an
    /// environment never comes back: it is a box, and rays are straight.
    pub fn is_local(&self) -> bool {
        self.environment == self.source.environment
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

/// What a message is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MessageKind {
    /// [`Message::Source`].
    Source,
    /// [`Message::Update`].
    Update,
    /// [`Message::Collect`].
    Collect,
    /// [`Message::Sums`].
    Sums,
    /// [`Message::StopSelecting`].
    StopSelecting,
    /// [`Message::Token`].
    Token,
    /// [`Message::Done`].
    Done,
}

impl MessageKind {
    /// Every kind, in the order of the bytes with which messages begin.
    pub const ALL: [MessageKind; 7] = [
        MessageKind::Source,
        MessageKind::Update,
        MessageKind::Collect,
        MessageKind::Sums,
        MessageKind::StopSelecting,
        MessageKind::Token,
        MessageKind::Done,
    ];

    /// The kind of an encoded message.
    pub fn of(bytes: &[u8]) -> Option<MessageKind> {
        MessageKind::ALL.get(usize::from(*bytes.first()?)).copied()
    }

    /// Its name, for people.
    pub fn name(self) -> &'static str {
        match self {
            MessageKind::Source => "source",
            MessageKind::Update => "update",
            MessageKind::Collect => "collect",
            MessageKind::Sums => "sums",
            MessageKind::StopSelecting => "stop selecting",
            MessageKind::Token => "token",
            MessageKind::Done => "done",
        }
    }
}

/// Bytes that are not a message.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("not a message: {0}")]
pub struct DecodeError(pub(crate) &'static str);

impl Message {
    /// The bytes that travel, little-endian.
    pub fn encode(&self) -> Vec<u8> {
        let mut to = Vec::new();
        match self {
            Message::Source(parcel) => {
                let bits = parcel.mask.pixels() / parcel.mask.pixels_a_bit();
                to.reserve(160 + bits as usize / 8);
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
            _ => return Err(DecodeError("unknown kind")),
        };
        if from.0.is_empty() { Ok(message) } else { Err(DecodeError("bytes left over")) }
    }
}

/// Bits of a message that hold the number of pixels; [`radiosity::MOST_PIXELS`] fits them.
const PIXEL_BITS: u32 = 25;

fn encode_parcel(parcel: &Parcel, to: &mut Vec<u8>) {
    let Parcel { environment, source, mask, form_factor } = parcel;
    // Pixels take 25 bits; above them stands how many share a bit.
    let pixels = mask.pixels() | mask.pixels_a_bit().trailing_zeros() << PIXEL_BITS;
    let numbers = [*environment, source.environment, source.patch, source.polygon, pixels];
    numbers.iter().for_each(|n| to.extend(n.to_le_bytes()));
    for vector in [source.centre, source.normal, source.power, source.radiosity] {
        vector.to_array().iter().for_each(|x| to.extend(x.to_le_bytes()));
    }
    to.extend(form_factor.to_le_bytes());
    mask.travelling().iter().for_each(|word| to.extend(word.to_le_bytes()));
}

fn decode_parcel(from: &mut Reader) -> Result<Parcel, DecodeError> {
    let (environment, source_environment) = (from.u32()?, from.u32()?);
    let (patch, polygon, pixels) = (from.u32()?, from.u32()?, from.u32()?);
    let source = Source {
        environment: source_environment,
        patch,
        polygon,
        centre: from.vector()?,
        normal: from.vector()?,
        power: from.vector()?,
        radiosity: from.vector()?,
    };
    let form_factor = from.f64()?;
    let words = std::mem::take(&mut from.0);
    let words = words.chunks(8).map(|chunk| Reader(chunk).take().map(u64::from_le_bytes));
    let (pixels, logarithm) = (pixels & ((1 << PIXEL_BITS) - 1), pixels >> PIXEL_BITS);
    let mask = Mask::arrived(words.collect::<Result<_, _>>()?, pixels, 1 << logarithm)
        .ok_or(DecodeError("mask and pixels differ"))?;
    Ok(Parcel { environment, source, mask, form_factor })
}

/// Bytes not read yet.
pub(crate) struct Reader<'a>(pub(crate) &'a [u8]);

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], DecodeError> {
        let (taken, rest) = self.0.split_first_chunk().ok_or(DecodeError("too short"))?;
        self.0 = rest;
        Ok(*taken)
    }

    pub(crate) fn byte(&mut self) -> Result<u8, DecodeError> {
        self.take().map(|[byte]| byte)
    }

    pub(crate) fn u32(&mut self) -> Result<u32, DecodeError> {
        self.take().map(u32::from_le_bytes)
    }

    pub(crate) fn u64(&mut self) -> Result<u64, DecodeError> {
        self.take().map(u64::from_le_bytes)
    }

    fn f32(&mut self) -> Result<f32, DecodeError> {
        self.take().map(f32::from_le_bytes)
    }

    pub(crate) fn f64(&mut self) -> Result<f64, DecodeError> {
        self.take().map(f64::from_le_bytes)
    }

    fn vector(&mut self) -> Result<DVec3, DecodeError> {
        Ok(DVec3::new(self.f64()?, self.f64()?, self.f64()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parcel(pixels: u32) -> Message {
        let mut mask = Mask::none(pixels);
        (0..pixels).step_by(3).for_each(|i| mask.set(i));
        let source = Source {
            environment: 7,
            patch: 1_234,
            polygon: 99,
            centre: DVec3::new(0.1, -0.2, 1e6),
            normal: DVec3::Z,
            power: DVec3::new(1.0, 2.0, 3.5),
            radiosity: DVec3::new(10.0, 20.0, 35.0),
        };
        Message::Source(Box::new(Parcel { environment: 8, source, mask, form_factor: 0.25 }))
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
        }
    }

    /// §4.2.3: "The message size is approximatively 4KBytes".
    #[test]
    fn a_source_of_the_default_hemisphere_takes_4_kb() {
        let bytes = parcel(30_976).encode().len();
        assert_eq!(bytes, 1 + 5 * 4 + 4 * 24 + 8 + 3_872);
        assert!(bytes <= 4_096);
    }

    #[test]
    fn bytes_that_are_no_message_are_refused() {
        let whole = parcel(65).encode();
        for length in 0..whole.len() {
            assert!(Message::decode(&whole[..length]).is_err(), "{length}");
        }
        assert!(Message::decode(&[6, 6]).is_err());
        assert!(Message::decode(&[99]).is_err());
    }
}
