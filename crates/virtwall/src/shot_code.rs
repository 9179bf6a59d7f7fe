//! A shot as bytes: how it is kept, in memory and in files. Of a mask only the words that hold a true
//! pixel are written, and which these are: most masks are few pixels close together.

use radiosity::{LocalEnvironment, Mask, Operation, Outgoing, Shot, Side, Work};

use crate::message::{DecodeError, Reader};

/// The bytes of a shot, little-endian.
pub(crate) fn encode(shot: &Shot) -> Vec<u8> {
    let mut to = Vec::with_capacity(1_024);
    shot.work.counts().for_each(|(_, times)| to.extend(times.to_le_bytes()));
    to.extend(shot.backs.to_le_bytes());
    to.extend(shot.escaped.to_le_bytes());
    to.extend((shot.hits.len() as u32).to_le_bytes());
    for (patch, form_factor) in &shot.hits {
        to.extend(patch.to_le_bytes());
        to.extend(form_factor.to_le_bytes());
    }
    for outgoing in &shot.outgoing {
        to.push(u8::from(outgoing.is_some()));
        if let Some(Outgoing { mask, form_factor }) = outgoing {
            to.extend(form_factor.to_le_bytes());
            encode_words(mask.words(), &mut to);
        }
    }
    to
}

fn encode_words(words: &[u64], to: &mut Vec<u8>) {
    for block in words.chunks(64) {
        let held = block.iter().zip(0..).map(|(&word, i)| u64::from(word != 0) << i);
        to.extend(held.fold(0, |all, bit| all | bit).to_le_bytes());
        block.iter().filter(|&&word| word != 0).for_each(|word| to.extend(word.to_le_bytes()));
    }
}

/// The shot that bytes stand for, if it can be one in this environment with masks of so many pixels.
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
    let (backs, escaped) = (from.f64()?, from.f64()?);
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
        if from.byte()? != 0 {
            let form_factor = from.f64()?;
            let mask = decode_mask(&mut from, pixels)?;
            if !environment.has_neighbour(side) {
                return Err(DecodeError("no neighbour there"));
            }
            outgoing[side.index()] = Some(Outgoing { mask, form_factor });
        }
    }
    if !from.0.is_empty() {
        return Err(DecodeError("bytes left over"));
    }
    Ok(Shot { hits, backs, escaped, outgoing, work })
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
