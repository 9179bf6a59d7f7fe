// A scene, shared by its runs: patches, local environments, and what each shot hits.

class Scene {
  static async load(index) {
    const scene = new Scene(index, await unpack(index.block));
    scene.shots = index.shots ? new Shots(await unpack(index.shots)) : null;
    // The reference radiosity, W/m², three colours per patch, if there is one.
    scene.reference = index.reference ? (await unpack(index.reference)).floats() : null;
    return scene;
  }

  constructor(index, columns) {
    this.name = index.name;
    [this.low, this.high] = split(columns.floats(), 3);
    this.boxes = split(columns.floats(), 6);
    this.materials = split(columns.floats(), 6);
    this.materialOf = columns.ints();
    this.patchStarts = starts(columns.ints());
    this.polygons = columns.deltas();
    this.cornerStarts = starts(columns.ints());
    this.corners = Uint32Array.from(columns.deltas());
    this.positions = this.decode([columns.deltas(), columns.deltas(), columns.deltas()]);
    this.areas = columns.floats();
    this.patches = this.polygons.length;
    this.environments = this.boxes.length;
  }

  /** Positions of corners in metres, from 16 bits per axis. */
  decode(axes) {
    const positions = new Float32Array(3 * axes[0].length);
    for (let axis = 0; axis < 3; axis++) {
      const step = (this.high[axis] - this.low[axis]) / 65535;
      axes[axis].forEach((value, i) => (positions[3 * i + axis] = this.low[axis] + step * value));
    }
    return positions;
  }

  material(patch) {
    return this.materials[this.materialOf[this.polygons[patch]]];
  }

  /** The environment of a patch. */
  environmentOf(patch) {
    return upperBound(this.patchStarts, patch) - 1;
  }

  /** What all patches emit, W/m², three colours per patch. */
  emission() {
    const light = new Float32Array(3 * this.patches);
    for (let patch = 0; patch < this.patches; patch++) {
      light.set(this.material(patch).subarray(3, 6), 3 * patch);
    }
    return light;
  }
}

/** What each shot of a source in one environment hits: geometry, the same in all runs. Form factors are in
 *  multiples of `unit`. */
class Shots {
  constructor(columns) {
    this.unit = columns.floats()[0];
    this.environments = columns.ints();
    const hits = columns.ints();
    this.starts = starts(hits);
    this.patches = columns.ints();
    this.weights = columns.ints();
    [this.backs, this.escaped, this.medium, this.outgoing] = [0, 1, 2, 3].map(() => columns.ints());
    for (let shot = 0; shot < hits.length; shot++) {
      for (let i = this.starts[shot] + 1; i < this.starts[shot + 1]; i++) {
        this.patches[i] += this.patches[i - 1];
      }
    }
  }
}

function split(values, size) {
  return Array.from({ length: values.length / size }, (_, i) => values.subarray(size * i, size * (i + 1)));
}

/** The number of values, sorted by size, that are at most `value`. */
function upperBound(values, value, low = 0, high = values.length) {
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return low;
}
