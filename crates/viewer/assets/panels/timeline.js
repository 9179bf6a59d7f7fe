// The timeline: a row for each node, coloured by its state, with messages and the critical path.

const MARGIN = 34; // pixels on the left, for the numbers of nodes
const RULER = 18; // pixels at the top, for the time
const MOST_ARROWS = 600;

class Timeline {
  constructor(state) {
    this.state = state;
    this.canvas = byId("timeline");
    // In pixels: the width without the margin, the height of a row. Kept, since asking the page is slow.
    [this.width, this.rowHeight] = [1, 1];
    state.onChange((names) => {
      if (names.has("time") && !names.has("window")) this.follow();
      if (["window", "selection", "run", "grown"].some((name) => names.has(name))) this.redraw();
      this.placeCursor();
    });
    for (const id of ["critical", "arrows"]) byId(id).addEventListener("input", () => this.redraw());
    byId("zoom-in").addEventListener("click", () => this.zoom(0.5, state.time));
    byId("zoom-out").addEventListener("click", () => this.zoom(2, state.time));
    byId("zoom-all").addEventListener("click", () => state.set({ window: [0, state.run.end] }));
    new ResizeObserver(() => this.redraw()).observe(this.canvas);
    this.listen();
    this.legend();
  }

  legend() {
    const shown = new Map(NODE_STATES.map(({ key, name }) => [key, name]));
    shown.set("overhead", "overhead").set("waiting", "waiting");
    byId("legend").replaceChildren(...[...shown].map(([key, name]) => {
      const entry = document.createElement("span");
      const swatch = document.createElement("i");
      swatch.style.background = `var(--${key})`;
      entry.append(swatch, name);
      return entry;
    }));
  }

  listen() {
    const { canvas, state } = this;
    let drag = null;
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      drag = { x: event.offsetX, window: state.window, moved: false };
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!state.run) return;
      if (!drag) return this.showSpan(event.offsetX, event.offsetY);
      const shift = ((drag.x - event.offsetX) / this.width) * (drag.window[1] - drag.window[0]);
      drag.moved ||= Math.abs(drag.x - event.offsetX) > 3;
      if (drag.moved) this.show(drag.window[0] + shift, drag.window[1] + shift);
    });
    canvas.addEventListener("pointerup", (event) => {
      if (drag && !drag.moved && state.run) {
        const node = this.nodeAt(event.offsetY);
        state.goTo(this.timeAt(event.offsetX));
        if (node >= 0 && node < state.run.computeNodes) state.set({ selection: { kind: "processor", number: node } });
        this.showSpan(event.offsetX, event.offsetY);
      }
      drag = null;
    });
    canvas.addEventListener("pointercancel", () => (drag = null));
    canvas.addEventListener("wheel", (event) => {
      if (!state.run || !(event.ctrlKey || document.activeElement === canvas)) return;
      event.preventDefault();
      this.zoom(Math.exp(event.deltaY / 300), this.timeAt(event.offsetX));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  key(event) {
    const { state } = this;
    if (!state.run || event.ctrlKey || event.metaKey || event.altKey) return;
    const [from, to] = state.window;
    const step = (to - from) / 50;
    const select = (by) => {
      const node = Math.max(0, Math.min(state.run.computeNodes - 1, state.node + by));
      state.set({ selection: { kind: "processor", number: node } });
    };
    const act = {
      ArrowLeft: () => state.goTo(state.time - step),
      ArrowRight: () => state.goTo(state.time + step),
      ArrowUp: () => select(-1),
      ArrowDown: () => select(1),
      "+": () => this.zoom(0.5, state.time),
      "=": () => this.zoom(0.5, state.time),
      "-": () => this.zoom(2, state.time),
      Home: () => state.goTo(0),
      End: () => state.goTo(state.run.end),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
    if (state.node >= 0) byId("span").textContent = this.describe(state.node, state.time);
  }

  /** Sets the window of time, within the run. */
  show(from, to) {
    const { end } = this.state.run;
    const length = Math.min(to - from, end);
    const start = Math.max(0, Math.min(from, end - length));
    this.state.set({ window: [start, start + length] });
  }

  zoom(factor, around) {
    const [from, to] = this.state.window;
    const length = Math.max(1e-6, (to - from) * factor);
    const at = Math.max(from, Math.min(to, around));
    this.show(at - ((at - from) / (to - from)) * length, at + ((to - at) / (to - from)) * length);
  }

  /** Moves the window of time so that it contains the shown time. */
  follow() {
    const { time, window: [from, to] } = this.state;
    if (time < from) this.show(time, time + to - from);
    else if (time > to) this.show(time - (to - from) * 0.1, time + (to - from) * 0.9);
  }

  x(time) {
    const [from, to] = this.state.window;
    return MARGIN + ((time - from) / (to - from)) * this.width;
  }

  timeAt(x) {
    const [from, to] = this.state.window;
    return from + ((x - MARGIN) / this.width) * (to - from);
  }

  nodeAt(y) {
    const node = Math.floor((y - RULER) / this.rowHeight);
    return node >= 0 && node < this.state.run.nodes ? node : -1;
  }

  redraw() {
    if (!this.state.run || this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      const rows = this.state.run.nodes <= 24 ? 12 : this.state.run.nodes <= 80 ? 4.5 : 320 / this.state.run.nodes;
      this.canvas.style.height = `${Math.round(RULER + rows * this.state.run.nodes)}px`;
      this.draw();
      this.placeCursor();
    });
  }

  placeCursor() {
    if (!this.state.run) return;
    const x = this.x(this.state.time);
    const cursor = byId("cursor");
    cursor.style.transform = `translateX(${x}px)`;
    cursor.hidden = x < MARGIN - 1 || x > MARGIN + this.width + 1;
  }

  draw() {
    const { context, width, height } = fit(this.canvas);
    this.width = width - MARGIN;
    this.rowHeight = (height - RULER) / this.state.run.nodes;
    this.colours = Object.fromEntries(
      [...NODE_STATES.map(({ key }) => key), "waiting", "text", "faint", "ruler", "accent", "path"].map((key) => [key, colourOf(key)]));
    context.font = "11px system-ui, sans-serif";
    this.drawRuler(context, height);
    for (let node = 0; node < this.state.run.nodes; node++) this.drawRow(context, node);
    context.save();
    context.beginPath();
    context.rect(MARGIN, 0, this.width, height);
    context.clip();
    if (byId("arrows").checked) this.drawMessages(context);
    if (byId("critical").checked) this.drawCritical(context);
    context.restore();
  }

  drawRuler(context, height) {
    const [from, to] = this.state.window;
    const step = roundStep((to - from) / Math.max(2, this.width / 110));
    context.textAlign = "left";
    for (let tick = Math.ceil(from / step) * step; tick <= to; tick += step) {
      context.fillStyle = this.colours.faint;
      context.fillRect(this.x(tick), RULER - 5, 1, height);
      context.fillStyle = this.colours.ruler;
      context.fillText(seconds(tick, step / 2), this.x(tick) + 3, 11);
    }
  }

  drawRow(context, node) {
    const { run, window: [from, to] } = this.state;
    const { spans } = run;
    const [top, tall] = [RULER + node * this.rowHeight, Math.max(1, this.rowHeight - (this.rowHeight > 3 ? 1 : 0))];
    context.fillStyle = this.colours.waiting;
    context.fillRect(MARGIN, top, this.width, tall);
    if (node === this.state.node) {
      context.strokeStyle = this.colours.accent;
      context.strokeRect(MARGIN - 0.5, top - 0.5, this.width, tall + 1);
    }
    if (this.rowHeight >= 9 || node % Math.ceil(10 / this.rowHeight) === 0) {
      context.fillStyle = node === this.state.node ? this.colours.accent : this.colours.text;
      context.textAlign = "right";
      context.fillText(node === run.computeNodes ? "host" : String(node), MARGIN - 5, top + tall / 2 + 4);
    }
    let span = Math.max(spans.starts[node], upperBound(spans.from, from, spans.starts[node], spans.starts[node + 1]) - 1);
    // Spans narrower than a pixel share it, in proportion to the seconds `spent` in each state.
    let [pixel, spent] = [-1, new Float64Array(NODE_STATES.length)];
    const flush = () => {
      if (pixel < 0) return;
      const whole = (to - from) / this.width;
      let left = MARGIN + pixel;
      spent.forEach((time, state) => {
        const wide = Math.min(1, time / whole);
        if (!(wide > 0.02)) return;
        context.fillStyle = this.colours[NODE_STATES[state].key];
        context.fillRect(left, top, wide, tall);
        left += wide;
      });
      spent.fill(0);
    };
    for (; span < spans.starts[node + 1] && spans.from[span] < to; span++) {
      const [left, right] = [Math.max(this.x(spans.from[span]), MARGIN), Math.min(this.x(spans.to[span]), MARGIN + this.width)];
      if (right <= left) continue;
      if (right - left < 1) {
        const here = Math.floor(left - MARGIN);
        if (here !== pixel) flush();
        pixel = here;
        spent[spans.states[span]] += spans.to[span] - spans.from[span];
        continue;
      }
      flush();
      pixel = -1;
      context.fillStyle = this.colours[NODE_STATES[spans.states[span]].key];
      context.fillRect(left, top, right - left - (right - left > 4 && this.rowHeight > 3 ? 0.5 : 0), tall);
    }
    flush();
  }

  middle(node) {
    return RULER + (node + 0.5) * this.rowHeight;
  }

  /** The messages in the window, of the selected node only if one is selected; none if they are too many to see. */
  visibleMessages() {
    const { run, window: [from, to], node } = this.state;
    const { sent, arrived, from: sender, to: receiver } = run.messages;
    const found = [];
    for (let i = upperBound(sent, from - run.longestFlight); i < sent.length && sent[i] < to; i++) {
      if (arrived[i] < from || (node >= 0 && sender[i] !== node && receiver[i] !== node)) continue;
      if (found.push(i) > MOST_ARROWS) return [];
    }
    return found;
  }

  drawMessages(context) {
    const { messages } = this.state.run;
    context.strokeStyle = context.fillStyle = this.colours.text;
    context.lineWidth = 1;
    for (const i of this.visibleMessages()) {
      const [x1, y1] = [this.x(messages.sent[i]), this.middle(messages.from[i])];
      const [x2, y2] = [this.x(messages.arrived[i]), this.middle(messages.to[i])];
      context.globalAlpha = messages.kind[i] === SOURCE ? 0.8 : 0.3;
      context.beginPath();
      context.moveTo(x1, y1);
      context.lineTo(x2, y2);
      context.stroke();
      const angle = Math.atan2(y2 - y1, x2 - x1);
      context.beginPath();
      context.moveTo(x2, y2);
      context.lineTo(x2 - 6 * Math.cos(angle - 0.4), y2 - 6 * Math.sin(angle - 0.4));
      context.lineTo(x2 - 6 * Math.cos(angle + 0.4), y2 - 6 * Math.sin(angle + 0.4));
      context.fill();
    }
    context.globalAlpha = 1;
  }

  /** The chain of work and messages that determined when the run ended. */
  drawCritical(context) {
    const { critical } = this.state.run;
    context.strokeStyle = this.colours.path;
    context.lineWidth = 2;
    context.lineJoin = "round";
    context.beginPath();
    critical.forEach(({ node, from, to }, i) => {
      const y = this.middle(node);
      if (i === 0) context.moveTo(this.x(from), y);
      else context.lineTo(this.x(from), y);
      context.lineTo(this.x(to), y);
    });
    context.stroke();
    context.lineWidth = 1;
  }

  showSpan(x, y) {
    const node = this.nodeAt(y);
    if (node >= 0 && x >= MARGIN) byId("span").textContent = this.describe(node, this.timeAt(x));
  }

  /** What a node does at a time, as text. */
  describe(node, time) {
    const { run } = this.state;
    const { spans } = run;
    const name = node === run.computeNodes ? "Service node" : `Node ${node}`;
    const span = run.spanAt(node, time);
    if (span < 0) return `${name} is waiting at ${seconds(time, run.end / 1e4)}`;
    const [from, to] = [spans.from[span], spans.to[span]];
    let text = `${name}: ${NODE_STATES[spans.states[span]].name} for ${duration(to - from)} from ${seconds(from, (to - from) / 10)}`;
    if (spans.shot[span] >= 0) {
      const emitter = spans.emitter[span];
      const { environment, patch } = spans.emitters;
      text += `; light of patch ${patch[emitter]} of environment ${environment[emitter]} shot in environment ` +
        `${run.scene.shots.environments[spans.shot[span]]}, ${spans.queue[span]} sources wait in its queue`;
    }
    return text;
  }
}

function duration(time) {
  if (time >= 1) return `${time.toPrecision(4)} s`;
  return time >= 1e-3 ? `${(time * 1e3).toPrecision(4)} ms` : `${(time * 1e6).toPrecision(4)} µs`;
}
