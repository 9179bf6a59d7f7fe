//! The bytes of a source: "The message size is approximatively 4KBytes" (§4.2.3).

use radiosity::{DepthBits, Emitter, Mask};

use super::reader::{DecodeError, Reader};
use super::words::little_endian;
use crate::problem::Source;

/// Bits of a message that hold the number of pixels; [`radiosity::MOST_PIXELS`] fits them.
const PIXEL_BITS: u32 = 25;

/// Sizes of the integers of masks where there are media.
const DEPTHS: [DepthBits; 2] = [DepthBits::Eight, DepthBits::Sixteen];

/// How a mask is sent: a bit a pixel, or an integer of 8 or 16 bits a pixel.
fn layout(mask: &Mask) -> u32 {
    match mask.depth_bits() {
        None => 0,
        Some(DepthBits::Eight) => 1,
        Some(DepthBits::Sixteen) => 2,
    }
}

/// Append the bytes of a source.
pub(super) fn encode(source: &Source, to: &mut Vec<u8>) {
    let Source { environment, shot, emitter, mask, form_factor } = source;
    to.reserve(160 + (mask.pixels() * mask.bits_a_pixel() / 8) as usize);
    let pixels = mask.pixels() | layout(mask) << PIXEL_BITS;
    let numbers =
        [*environment, *shot, emitter.environment, emitter.patch, emitter.polygon, pixels];
    numbers.iter().for_each(|n| to.extend(n.to_le_bytes()));
    for vector in [emitter.centre, emitter.normal, emitter.power, emitter.radiosity] {
        vector.to_array().iter().for_each(|x| to.extend(x.to_le_bytes()));
    }
    to.extend(form_factor.to_le_bytes());
    match mask.steps() {
        None => to.extend_from_slice(&little_endian(mask.words())),
        Some((steps, DepthBits::Eight)) => to.extend(steps.iter().map(|&steps| steps as u8)),
        Some((steps, DepthBits::Sixteen)) => {
            steps.iter().for_each(|steps| to.extend(steps.to_le_bytes()));
        }
    }
}

/// Decodes a source. Its mask takes all bytes that are left.
pub(super) fn decode(from: &mut Reader) -> Result<Source, DecodeError> {
    let (environment, shot, emitter_environment) = (from.u32()?, from.u32()?, from.u32()?);
    let (patch, polygon, pixels) = (from.u32()?, from.u32()?, from.u32()?);
    let emitter = Emitter {
        environment: emitter_environment,
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
    Ok(Source { environment, shot, emitter, mask, form_factor })
}

/// A mask of `pixels` pixels from its bytes.
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
