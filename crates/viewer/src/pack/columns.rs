//! A block of data as the page reads it: columns of numbers, compressed, in base64. Read by
//! `assets/data/columns.js`.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use miniz_oxide::deflate::compress_to_vec_zlib;

/// Compression level of 0 to 10: level 6 takes twice as long and saves 3 %.
const LEVEL: u8 = 4;

/// Columns, one after the other; each is the count of its numbers and then the numbers.
#[derive(Default)]
pub(crate) struct Columns {
    bytes: Vec<u8>,
}

impl Columns {
    /// Unsigned numbers in bytes of seven bits, the lowest bits first (LEB128).
    pub fn ints(&mut self, values: impl IntoIterator<Item = u64>) {
        let values: Vec<u64> = values.into_iter().collect();
        self.number(values.len() as u64);
        values.into_iter().for_each(|value| self.number(value));
    }

    /// Numbers as differences, with the sign in the lowest bit (zigzag).
    pub fn deltas(&mut self, values: impl IntoIterator<Item = i64>) {
        let mut last = 0;
        let zigzag = |value: i64| {
            let delta = value - std::mem::replace(&mut last, value);
            ((delta << 1) ^ (delta >> 63)) as u64
        };
        self.ints(values.into_iter().map(zigzag));
    }

    /// Numbers in single precision.
    pub fn floats(&mut self, values: impl IntoIterator<Item = f64>) {
        let values: Vec<f64> = values.into_iter().collect();
        self.number(values.len() as u64);
        values.iter().for_each(|&value| self.bytes.extend((value as f32).to_le_bytes()));
    }

    fn number(&mut self, mut value: u64) {
        while value >= 128 {
            self.bytes.push(value as u8 | 128);
            value >>= 7;
        }
        self.bytes.push(value as u8);
    }

    /// The block as text for the page.
    pub fn pack(&self) -> String {
        STANDARD.encode(compress_to_vec_zlib(&self.bytes, LEVEL))
    }
}

/// Reads a block as the page does.
#[cfg(test)]
pub(crate) struct Reader {
    bytes: std::vec::IntoIter<u8>,
}

#[cfg(test)]
impl Reader {
    pub fn unpack(block: &str) -> Reader {
        let packed = STANDARD.decode(block).unwrap();
        let bytes = miniz_oxide::inflate::decompress_to_vec_zlib(&packed).unwrap();
        Reader { bytes: bytes.into_iter() }
    }

    fn number(&mut self) -> u64 {
        let byte = u64::from(self.bytes.next().unwrap());
        if byte < 128 { byte } else { byte - 128 + 128 * self.number() }
    }

    pub fn ints(&mut self) -> Vec<u64> {
        (0..self.number()).map(|_| self.number()).collect()
    }

    pub fn floats(&mut self) -> Vec<f32> {
        let count = self.number();
        let mut float = || f32::from_le_bytes([0; 4].map(|_| self.bytes.next().unwrap()));
        (0..count).map(|_| float()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_numbers_and_small_differences_take_a_byte() {
        let mut columns = Columns::default();
        columns.ints([0, 127, 128]);
        columns.deltas([1000, 999, 1000]);
        columns.floats([1.0]);
        let expected = [3, 0, 127, 128, 1, 3, 0xd0, 0x0f, 1, 2, 1, 0, 0, 0x80, 0x3f];
        assert_eq!(columns.bytes, expected);
    }
}
