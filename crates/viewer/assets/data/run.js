// One run: what each node did when, its messages, its light.

/** The states of a node, in the order of viewer/src/record/node_state.rs. */
const NODE_STATES = [
  { key: "local", name: "local shot" },
  { key: "received", name: "received shot" },
  { key: "selection", name: "selection" },
  { key: "overhead", name: "sending" },
  { key: "overhead", name: "receiving" },
  { key: "token", name: "token and control" },
  { key: "paging", name: "paging" },
  { key: "held", name: "waiting for room" },
];
const [LOCAL, RECEIVED, SELECTION] = [0, 1, 2];
/** Numbers of kinds of messages, as in virtwall's MessageKind. */
const [SOURCE, TOKEN] = [0, 5];

class Run {
  static async load(index, scene) {
    return new Run(index, scene).read(await unpack(index.block));
  }

  constructor(index, scene) {
    this.index = index;
    this.scene = scene;
  }

  read(columns) {
    this.owners = columns.ints();
    this.spans = new Spans(columns);
    this.nodes = this.spans.starts.length - 1;
    this.readMessages(columns);
    const [node, from, span, state] = [0, 1, 2, 3].map(() => columns.ints());
    this.critical = Array.from(node, (n, i) => ({
      node: n, from: from[i] / 1e9, to: (from[i] + span[i]) / 1e9, state: state[i],
    }));
    this.end = this.index.time_s;
    this.orderShots();
    return this;
  }

  readMessages(columns) {
    const seconds = (values) => values.map((value) => value / 1e9);
    const sent = seconds(columns.deltas());
    const arrived = seconds(columns.ints()).map((flight, i) => sent[i] + flight);
    const [from, to, kind, bytes] = [0, 1, 2, 3].map(() => columns.ints());
    this.messages = { sent, arrived, from, to, kind, bytes };
    this.longestFlight = arrived.reduce((most, at, i) => Math.max(most, at - sent[i]), 0);
  }

  /** Shots of all nodes by the time at which they end, when light changes. */
  orderShots() {
    const { states, to } = this.spans;
    const shots = [];
    for (let i = 0; i < states.length; i++) if (states[i] <= RECEIVED) shots.push(i);
    shots.sort((a, b) => to[a] - to[b] || a - b);
    this.shots = Uint32Array.from(shots);
    this.shotEnds = Float64Array.from(shots, (span) => to[span]);
  }

  /** The number of compute nodes; the service node has the rank that follows. */
  get computeNodes() {
    return this.index.processors;
  }

  environmentsOf(node) {
    return Array.from(this.owners.keys()).filter((e) => this.owners[e] === node);
  }

  /** The span that a node is in, or -1 while it waits. */
  spanAt(node, time) {
    const { from, to, starts } = this.spans;
    const span = upperBound(from, time, starts[node], starts[node + 1]) - 1;
    return span >= starts[node] && time < to[span] ? span : -1;
  }

  /** Seconds that a node has computed until `time`. */
  busyUntil(node, time) {
    const { from, to, starts, busy } = this.spans;
    const next = upperBound(from, time, starts[node], starts[node + 1]);
    if (next === starts[node]) return 0;
    const last = next - 1;
    const over = Math.max(0, to[last] - time);
    return busy[last] - (this.spans.states[last] <= SELECTION ? over : 0);
  }

  /** Length of a node's queue and its memory in use at its last shot before `time`. */
  queueAt(node, time) {
    const { from, starts, queue, memory } = this.spans;
    let span = upperBound(from, time, starts[node], starts[node + 1]) - 1;
    while (span >= starts[node] && queue[span] < 0) span--;
    return span < starts[node] ? { queue: 0, memory: 0 } : { queue: queue[span], memory: memory[span] };
  }
}

/** What nodes did, by node and time; between two spans a node waits. */
class Spans {
  constructor(columns) {
    const counts = columns.ints();
    this.starts = starts(counts);
    this.states = Uint8Array.from(columns.ints());
    const [gaps, lengths] = [columns.ints(), columns.ints()];
    const [shots, emitters, queues] = [columns.deltas(), columns.deltas(), columns.ints()];
    const memory = columns.ints();
    this.emitters = { environment: columns.ints(), patch: columns.ints() };
    this.powers = columns.floats();
    const n = this.states.length;
    [this.from, this.to, this.busy] = [0, 1, 2].map(() => new Float64Array(n));
    this.shot = new Int32Array(n).fill(-1);
    this.emitter = new Int32Array(n).fill(-1);
    this.queue = new Int32Array(n).fill(-1);
    this.memory = new Float64Array(n);
    let nth = 0;
    for (let node = 0; node < counts.length; node++) {
      let [time, busy] = [0, 0];
      for (let i = this.starts[node]; i < this.starts[node + 1]; i++) {
        this.from[i] = (time += gaps[i]) / 1e9;
        this.to[i] = (time += lengths[i]) / 1e9;
        if (this.states[i] <= SELECTION) busy += lengths[i];
        this.busy[i] = busy / 1e9;
        if (this.states[i] > RECEIVED) continue;
        this.shot[i] = shots[nth];
        this.emitter[i] = emitters[nth];
        this.queue[i] = queues[nth];
        this.memory[i] = memory.length ? memory[nth] : 0;
        nth++;
      }
    }
  }
}
