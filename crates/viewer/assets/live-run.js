// A run that is under way: it grows by the parts that viewer/src/broadcast.rs tells.

const SAMPLES = 10; // of energy, a part
const MOST_SAMPLES = 1000;

/** Numbers to which more are added; what lies beyond `length` is room. */
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

/** What shots hit, as Shots, of one run alone. */
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
    // Its shots are its own.
    super(index, Object.assign(Object.create(scene), { shots: new GrowingShots() }));
    Object.assign(this, { owners: index.owners, critical: [], end: 0, nodes: index.processors + 1 });
    this.lanes = Array.from({ length: this.nodes }, () => ({ time: 0, kinds: [], from: [], to: [], shots: [] }));
    this.told = { nodes: [], numbers: [], sources: [], queues: [], memory: [] };
    this.sources = { environment: [], patch: [], powers: new Growing(Float32Array) };
    this.messages = { sent: [], arrived: [], from: [], to: [], kind: [], bytes: [] };
    this.longestFlight = 0;
    this.doing = { kinds: [], since: [] };
    this.layOut();
    /** Energy at the front, for the course of it. */
    this.front = new Light(this);
    this.course = [{ time: 0, ...this.front.energy }];
  }

  /** One part more. */
  add(columns) {
    this.end = columns.ints()[0] / 1e9;
    this.addSpans(columns);
    const { nodes, numbers, sources, queues, memory } = this.told;
    for (const column of [nodes, numbers, sources, queues, memory]) append(column, columns.ints());
    append(this.sources.environment, columns.ints());
    append(this.sources.patch, columns.ints());
    this.sources.powers.push(columns.floats());
    this.scene.shots.add(columns);
    this.addMessages(columns);
  }

  addSpans(columns) {
    const counts = columns.ints();
    const [kinds, gaps, lengths] = [columns.ints(), columns.ints(), columns.ints()];
    let i = 0;
    counts.forEach((count, node) => {
      const lane = this.lanes[node];
      for (const last = i + count; i < last; i++) {
        if (kinds[i] <= RECEIVED) lane.shots.push(lane.kinds.length);
        lane.kinds.push(kinds[i]);
        lane.from.push((lane.time += gaps[i]) / 1e9);
        lane.to.push((lane.time += lengths[i]) / 1e9);
      }
    });
    this.doing = { kinds: columns.ints(), since: columns.ints() };
  }

  /** Messages come in the order in which they arrive, and are looked at in that in which they are sent. */
  addMessages(columns) {
    const all = this.messages;
    const sent = columns.steps().map((time) => time / 1e9);
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

  /** All parts so far, as the page looks at runs. */
  layOut() {
    const { lanes, told, end } = this;
    const starts = new Uint32Array(lanes.length + 1);
    const open = lanes.map((_, node) => this.doing.kinds[node] > 0);
    lanes.forEach((lane, node) => (starts[node + 1] = starts[node] + lane.kinds.length + (open[node] ? 1 : 0)));
    const n = starts[lanes.length];
    const spans = { starts, kinds: new Uint8Array(n), from: new Float64Array(n), to: new Float64Array(n) };
    spans.busy = new Float64Array(n);
    [spans.shot, spans.source, spans.queue] = [0, 1, 2].map(() => new Int32Array(n).fill(-1));
    spans.memory = new Float64Array(n);
    spans.sourcePlaces = this.sources;
    spans.powers = this.sources.powers.values;
    lanes.forEach((lane, node) => {
      const at = starts[node];
      for (const key of ["kinds", "from", "to"]) spans[key].set(lane[key], at);
      if (open[node]) {
        const last = starts[node + 1] - 1;
        spans.kinds[last] = this.doing.kinds[node] - 1;
        spans.from[last] = Math.min(this.doing.since[node] / 1e9, end);
        // What a node has not ended yet goes on beyond what is known.
        spans.to[last] = end + 1e-9;
      }
      let busy = 0;
      for (let i = at; i < starts[node + 1]; i++) {
        if (spans.kinds[i] <= 2) busy += spans.to[i] - spans.from[i];
        spans.busy[i] = busy;
      }
    });
    const shots = told.nodes.length;
    [this.shots, this.shotEnds] = [new Uint32Array(shots), new Float64Array(shots)];
    const next = new Uint32Array(lanes.length);
    told.nodes.forEach((node, i) => {
      const span = starts[node] + lanes[node].shots[next[node]++];
      spans.shot[span] = told.numbers[i];
      spans.source[span] = told.sources[i];
      spans.queue[span] = told.queues[i];
      spans.memory[span] = told.memory[i];
      this.shots[i] = span;
      this.shotEnds[i] = spans.to[span];
    });
    this.spans = spans;
    if (this.front) this.followEnergy();
  }

  /** Energy from where it was looked at last to the end. */
  followEnergy() {
    const { time } = this.course[this.course.length - 1];
    for (let i = 1; i <= SAMPLES; i++) {
      const now = time + ((this.end - time) * i) / SAMPLES;
      this.front.goTo(now);
      this.course.push({ time: now, ...this.front.energy });
    }
    // Enough to draw: what lies between may go.
    if (this.course.length > MOST_SAMPLES) this.course = this.course.filter((_, i) => i % 2 === 0 || i + 1 === this.course.length);
  }
}

function append(all, more) {
  for (const value of more) all.push(value);
}
