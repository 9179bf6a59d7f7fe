//! The encoding of protocol buffers, as far as traces need it.

/// A message: its fields, encoded.
#[derive(Default)]
pub(crate) struct Fields(pub(crate) Vec<u8>);

impl Fields {
    /// An unsigned integer, a Boolean or an enumeration.
    pub(crate) fn number(&mut self, field: u32, value: u64) {
        self.tag(field, 0);
        self.varint(value);
    }

    /// An integer of eight bytes.
    pub(crate) fn fixed(&mut self, field: u32, value: u64) {
        self.tag(field, 1);
        self.0.extend(value.to_le_bytes());
    }

    pub(crate) fn double(&mut self, field: u32, value: f64) {
        self.fixed(field, value.to_bits());
    }

    /// Bytes or text.
    pub(crate) fn bytes(&mut self, field: u32, value: &[u8]) {
        self.tag(field, 2);
        self.varint(value.len() as u64);
        self.0.extend(value);
    }

    /// A message within this one.
    pub(crate) fn message(&mut self, field: u32, write: impl FnOnce(&mut Fields)) {
        self.tag(field, 2);
        let at = self.0.len();
        self.0.push(0);
        write(self);
        let length = (self.0.len() - at - 1) as u64;
        // Nearly all lengths fit one byte.
        match u8::try_from(length) {
            Ok(short) if short < 0x80 => self.0[at] = short,
            _ => {
                let mut long = Fields::default();
                long.varint(length);
                self.0.splice(at..=at, long.0);
            }
        }
    }

    fn tag(&mut self, field: u32, wire_type: u32) {
        self.varint(u64::from(field << 3 | wire_type));
    }

    fn varint(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.0.push(value as u8 | 0x80);
            value >>= 7;
        }
        self.0.push(value as u8);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The examples in the documentation of the encoding.
    #[test]
    fn bytes_are_as_described() {
        let mut fields = Fields::default();
        fields.number(1, 150);
        fields.bytes(2, b"testing");
        fields.message(3, |inner| inner.number(1, 150));
        assert_eq!(fields.0, b"\x08\x96\x01\x12\x07testing\x1a\x03\x08\x96\x01");
    }

    #[test]
    fn a_long_message_has_a_long_length() {
        let mut fields = Fields::default();
        fields.message(1, |inner| inner.bytes(1, &[7; 300]));
        assert_eq!(fields.0[..6], [0x0a, 0xaf, 0x02, 0x0a, 0xac, 0x02]);
        assert_eq!(fields.0.len(), 306);
    }
}
