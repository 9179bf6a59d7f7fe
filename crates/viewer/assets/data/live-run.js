// A run that is under way: it grows by the parts that viewer/src/broadcast.rs packs.

const SAMPLES = 10; // of energy, per part
const MOST_SAMPLES = 1000;

/** An array of numbers that grows; values beyond `length` are unused. */
class Growing {
  constructor(Kind) {
    this.values = new Kind(64);
    this.length = 0;
  }

  push(more) {
    const length = this.length + more.length;
    if (length > this.values.length) {
      const values = new this.values.constructor(Math.max(length, 2 * this.values.length));
      values.set(this.values.subarray(0, this.length));
      this.values = values;
    }
    this.values.set(more, this.length);
    this.length = length;
  }
}

/** What shots hit, with the fields of Shots, of one run that grows. */
class GrowingShots {
  constructor() {
    this.columns = Array.from({ length: 7 }, () => new Growing(Uint32Array));
    this.ends = new Growing(Uint32Array);
    this.ends.push([0]);
    this.publish();
  }

  add(columns) {
    const more = new Shots(columns);
    this.unit = more.unit;
    const first = this.columns[1].length;
    this.ends.push(more.starts.subarray(1).map((start) => first + start));
    const { environments, patches, weights, backs, escaped, medium, outgoing } = more;
    [environments, patches, weights, backs, escaped, medium, outgoing].forEach((values, i) => this.columns[i].push(values));
    this.publish();
  }

  publish() {
    [this.environments, this.patches, this.weights, this.backs, this.escaped, this.medium, this.outgoing] =
      this.columns.map((column) => column.values);
    this.starts = this.ends.values;
  }
}

class LiveRun extends Run {
  constructor(index, scene) {
    // Other runs of the scene number their shots differently.
    super(index, Object.assign(Object.create(scene), { shots: new GrowingShots() }));
    Object.assign(this, { owners: index.owners, critical: [], end: 0, nodes: index.processors + 1 });
    this.rows = Array.from({ length: this.nodes }, () => ({ time: 0, states: [], from: [], to: [], shots: [] }));
    this.shotColumns = { nodes: [], numbers: [], emitters: [], queues: [], memory: [] };
    this.emitters = { environment: [], patch: [], powers: new Growing(Float32Array) };
    this.messages = { sent: [], arrived: [], from: [], to: [], kind: [], bytes: [] };
    this.longestFlight = 0;
    this.current = { states: [], since: [] };
    this.layOut();
    /** The light at the last known time, from which the history of energy is made. */
    this.latest = new Light(this);
    this.history = [{ time: 0, ...this.latest.energy }];
  }

  /** Adds a part. */
  add(columns) {
    this.end = columns.ints()[0] / 1e9;
    this.addSpans(columns);
    const { nodes, numbers, emitters, queues, memory } = this.shotColumns;
    for (const column of [nodes, numbers, emitters, queues, memory]) append(column, columns.ints());
    append(this.emitters.environment, columns.ints());
    append(this.emitters.patch, columns.ints());
    this.emitters.powers.push(columns.floats());
    this.scene.shots.add(columns);
    this.addMessages(columns);
  }

  addSpans(columns) {
    const counts = columns.ints();
    const [states, gaps, lengths] = [columns.ints(), columns.ints(), columns.ints()];
    let i = 0;
    counts.forEach((count, node) => {
      const row = this.rows[node];
      for (const last = i + count; i < last; i++) {
        if (states[i] <= RECEIVED) row.shots.push(row.states.length);
        row.states.push(states[i]);
        row.from.push((row.time += gaps[i]) / 1e9);
        row.to.push((row.time += lengths[i]) / 1e9);
      }
    });
    this.current = { states: columns.ints(), since: columns.ints() };
  }

  /** Adds messages. They come in the order of arrival and are kept in the order of sending. */
  addMessages(columns) {
    const all = this.messages;
    const sent = columns.deltas().map((time) => time / 1e9);
    const flights = columns.ints().map((time) => time / 1e9);
    append(all.sent, sent);
    append(all.arrived, sent.map((time, i) => time + flights[i]));
    for (const key of ["from", "to", "kind", "bytes"]) append(all[key], columns.ints());
    flights.forEach((flight) => (this.longestFlight = Math.max(this.longestFlight, flight)));
    const earliest = sent.reduce((least, time) => Math.min(least, time), Infinity);
    const first = upperBound(all.sent, earliest, 0, all.sent.length - sent.length);
    const order = Array.from({ length: all.sent.length - first }, (_, i) => first + i);
    order.sort((a, b) => all.sent[a] - all.sent[b]);
    for (const column of Object.values(all)) {
      order.map((i) => column[i]).forEach((value, i) => (column[first + i] = value));
    }
    this.linkUse = null;
  }

  /** Makes the fields of Run from all parts so far. */
  layOut() {
    const { rows, shotColumns, end } = this;
    const starts = new Uint32Array(rows.length + 1);
    const open = rows.map((_, node) => this.current.states[node] > 0);
    rows.forEach((row, node) => (starts[node + 1] = starts[node] + row.states.length + (open[node] ? 1 : 0)));
    const n = starts[rows.length];
    const spans = { starts, states: new Uint8Array(n), from: new Float64Array(n), to: new Float64Array(n) };
    spans.busy = new Float64Array(n);
    [spans.shot, spans.emitter, spans.queue] = [0, 1, 2].map(() => new Int32Array(n).fill(-1));
    spans.memory = new Float64Array(n);
    spans.emitters = this.emitters;
    spans.powers = this.emitters.powers.values;
    rows.forEach((row, node) => {
      const at = starts[node];
      for (const key of ["states", "from", "to"]) spans[key].set(row[key], at);
      if (open[node]) {
        const last = starts[node + 1] - 1;
        spans.states[last] = this.current.states[node] - 1;
        spans.from[last] = Math.min(this.current.since[node] / 1e9, end);
        // It goes on beyond the last known time.
        spans.to[last] = end + 1e-9;
      }
      let busy = 0;
      for (let i = at; i < starts[node + 1]; i++) {
        if (spans.states[i] <= SELECTION) busy += spans.to[i] - spans.from[i];
        spans.busy[i] = busy;
      }
    });
    const shots = shotColumns.nodes.length;
    [this.shots, this.shotEnds] = [new Uint32Array(shots), new Float64Array(shots)];
    const next = new Uint32Array(rows.length);
    shotColumns.nodes.forEach((node, i) => {
      const span = starts[node] + rows[node].shots[next[node]++];
      spans.shot[span] = shotColumns.numbers[i];
      spans.emitter[span] = shotColumns.emitters[i];
      spans.queue[span] = shotColumns.queues[i];
      spans.memory[span] = shotColumns.memory[i];
      this.shots[i] = span;
      this.shotEnds[i] = spans.to[span];
    });
    this.spans = spans;
    if (this.latest) this.followEnergy();
  }

  /** Adds samples of energy from the last sample to the end. */
  followEnergy() {
    const { time } = this.history[this.history.length - 1];
    for (let i = 1; i <= SAMPLES; i++) {
      const now = time + ((this.end - time) * i) / SAMPLES;
      this.latest.goTo(now);
      this.history.push({ time: now, ...this.latest.energy });
    }
    // More samples than a chart has pixels: every second one is enough.
    if (this.history.length > MOST_SAMPLES) this.history = this.history.filter((_, i, all) => i % 2 === 0 || i + 1 === all.length);
  }
}

function append(all, more) {
  for (const value of more) all.push(value);
}
