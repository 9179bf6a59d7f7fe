//! Encodes a shot as bytes, for memory and files. Of a mask only the words with a true pixel are written,
//! with their positions, since most masks consist of a few pixels close together.

use radiosity::{DepthBits, LocalEnvironment, Mask, Operation, Outgoing, Shot, Side, Work};

use crate::wire::{DecodeError, Reader};

/// The bytes of a shot, little-endian.
pub(crate) fn encode(shot: &Shot) -> Vec<u8> {
    let mut to = Vec::with_capacity(1_024);
    shot.work.counts().for_each(|(_, times)| to.extend(times.to_le_bytes()));
    to.extend(shot.backs.to_le_bytes());
    to.extend(shot.escaped.to_le_bytes());
    to.extend(shot.medium.to_le_bytes());
    to.extend((shot.hits.len() as u32).to_le_bytes());
    for (patch, form_factor) in &shot.hits {
        to.extend(patch.to_le_bytes());
        to.extend(form_factor.to_le_bytes());
    }
    for outgoing in &shot.outgoing {
        to.push(outgoing.as_ref().map_or(0, |outgoing| outgoing.mask.bits_a_pixel() as u8));
        if let Some(Outgoing { mask, form_factor }) = outgoing {
            to.extend(form_factor.to_le_bytes());
            encode_words(mask.words(), &mut to);
            let steps = mask.steps().map_or(&[][..], |(steps, _)| steps);
            let held = mask.ones().filter_map(|pixel| steps.get(pixel as usize));
            held.for_each(|steps| to.extend(steps.to_le_bytes()));
        }
    }
    to
}

/// For every 64 words of a mask: 64 bits that tell which words are not zero, then these words.
fn encode_words(words: &[u64], to: &mut Vec<u8>) {
    for block in words.chunks(64) {
        let held = block.iter().zip(0..).map(|(&word, i)| u64::from(word != 0) << i);
        let mut held = held.fold(0, |all, bit| all | bit);
        to.extend(held.to_le_bytes());
        while held != 0 {
            to.extend(block[held.trailing_zeros() as usize].to_le_bytes());
            held &= held - 1;
        }
    }
}

/// Decodes a shot. Refuses bytes that cannot be a shot in this environment with masks of `pixels` pixels.
pub(crate) fn decode(
    code: &[u8],
    environment: &LocalEnvironment,
    pixels: u32,
) -> Result<Shot, DecodeError> {
    let mut from = Reader(code);
    let mut work = Work::NONE;
    for &operation in Operation::ALL {
        work.count(operation, from.u64()?);
    }
    let (backs, escaped, medium) = (from.f64()?, from.f64()?, from.f64()?);
    let patches = environment.patches.len();
    let count = from.u32()? as usize;
    let mut hits = Vec::with_capacity(count.min(patches));
    for _ in 0..count {
        let hit = (from.u32()?, from.f64()?);
        if hit.0 as usize >= patches {
            return Err(DecodeError("no such patch"));
        }
        hits.push(hit);
    }
    let mut outgoing: [Option<Outgoing>; 6] = Default::default();
    for side in Side::ALL {
        let bits = from.byte()?;
        if bits != 0 {
            let form_factor = from.f64()?;
            let mask = decode_mask(&mut from, pixels)?;
            let mask = match DepthBits::of(bits.into()) {
                Some(bits) => decode_steps(&mut from, &mask, bits)?,
                None => mask,
            };
            if !environment.has_neighbour(side) {
                return Err(DecodeError("no neighbour there"));
            }
            outgoing[side.index()] = Some(Outgoing { mask, form_factor });
        }
    }
    if !from.0.is_empty() {
        return Err(DecodeError("bytes left over"));
    }
    Ok(Shot { hits, backs, escaped, medium, outgoing, work })
}

fn decode_mask(from: &mut Reader, pixels: u32) -> Result<Mask, DecodeError> {
    let mut words = vec![0; pixels.div_ceil(64) as usize];
    for block in words.chunks_mut(64) {
        let mut held = from.u64()?;
        while held != 0 {
            let place = block.get_mut(held.trailing_zeros() as usize);
            *place.ok_or(DecodeError("a word beyond the mask"))? = from.u64()?;
            held &= held - 1;
        }
    }
    Mask::from_words(words, pixels).ok_or(DecodeError("mask and pixels differ"))
}

/// The integers of the true pixels of a mask.
fn decode_steps(from: &mut Reader, mask: &Mask, bits: DepthBits) -> Result<Mask, DecodeError> {
    let mut steps = vec![bits.hidden(); mask.pixels() as usize];
    for pixel in mask.ones() {
        steps[pixel as usize] = from.u16()?;
    }
    let dimmed = Mask::from_steps(steps, bits).ok_or(DecodeError("integers beyond their bits"))?;
    let same = dimmed.words() == mask.words();
    if same { Ok(dimmed) } else { Err(DecodeError("integers and mask differ")) }
}
