// Reads blocks of data: compressed columns of numbers in base64, as viewer/src/pack/columns.rs writes them.

/** The columns of a block: from the page's element of this id or, if there is none, from the server. */
async function unpack(id) {
  const element = document.getElementById(id);
  return inflate(element ? element.textContent : await (await fetch(id)).text());
}

/** The columns of a block. */
async function inflate(block) {
  const text = atob(block);
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) packed[i] = text.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Columns(await new Response(stream).arrayBuffer());
}

/** Reads columns in the order in which they were written. */
class Columns {
  constructor(buffer) {
    this.bytes = new Uint8Array(buffer);
    this.view = new DataView(buffer);
    this.at = 0;
  }

  /** A number in bytes of seven bits, the lowest bits first (LEB128); exact up to 2^53. */
  number() {
    let value = 0;
    let scale = 1;
    for (;;) {
      const byte = this.bytes[this.at++];
      value += (byte & 127) * scale;
      if (byte < 128) return value;
      scale *= 128;
    }
  }

  /** Unsigned numbers. */
  ints() {
    const values = new Float64Array(this.number());
    for (let i = 0; i < values.length; i++) values[i] = this.number();
    return values;
  }

  /** Numbers stored as differences, with the sign in the lowest bit (zigzag). */
  deltas() {
    const values = this.ints();
    let last = 0;
    for (let i = 0; i < values.length; i++) {
      const coded = values[i];
      last += coded % 2 ? -(coded + 1) / 2 : coded / 2;
      values[i] = last;
    }
    return values;
  }

  /** Single-precision numbers. */
  floats() {
    const values = new Float32Array(this.number());
    for (let i = 0; i < values.length; i++, this.at += 4) {
      values[i] = this.view.getFloat32(this.at, true);
    }
    return values;
  }
}

/** Where each item's part of a column begins, for items of these lengths, and where the last one ends. */
function starts(lengths) {
  const sums = new Uint32Array(lengths.length + 1);
  for (let i = 0; i < lengths.length; i++) sums[i + 1] = sums[i] + lengths[i];
  return sums;
}
