// Data blocks: base64, deflated columns. The writer is viewer/src/columns.rs.

/** The columns of the block that lies in the page's element of this id, or beside a page that is served. */
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

  /** A number of seven bits a byte, the lowest first; exact to 2^53. */
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

  /** Numbers not below zero. */
  ints() {
    const values = new Float64Array(this.number());
    for (let i = 0; i < values.length; i++) values[i] = this.number();
    return values;
  }

  /** Numbers told by their differences, the sign in the lowest bit. */
  steps() {
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

/** Where each item's part of a column begins, for items of these lengths; one more at the end. */
function starts(lengths) {
  const places = new Uint32Array(lengths.length + 1);
  for (let i = 0; i < lengths.length; i++) places[i + 1] = places[i] + lengths[i];
  return places;
}
