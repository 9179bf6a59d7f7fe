// The machine: its nodes, its links, and the messages under way.

const FADE = 1 / 150; // of the time that the timeline shows: how long a message is still drawn after its arrival

class MachinePanel {
  constructor(state) {
    this.state = state;
    this.canvas = byId("machine");
    state.onChange((names) => {
      if (["run", "time", "selection", "grown"].some((name) => names.has(name))) this.redraw();
    });
    this.canvas.addEventListener("click", (event) => this.click(event));
    new ResizeObserver(() => this.redraw()).observe(this.canvas);
  }

  redraw() {
    if (!this.state.run || this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  /** The position of a node on the canvas. The machine's longer side is horizontal. */
  place(node) {
    const { width, height, places } = this.state.run.index.machine;
    const [x, y] = [places[node] % width, Math.floor(places[node] / width)];
    const [column, row] = height > width ? [y, x] : [x, y];
    return [this.margin + (column + 0.5) * this.pitch, this.margin + (row + 0.5) * this.pitch];
  }

  draw() {
    const { width, height } = this.state.run.index.machine;
    const [columns, rows] = [Math.max(width, height), Math.min(width, height)];
    this.margin = 3;
    this.pitch = (this.canvas.clientWidth - 2 * this.margin) / columns;
    this.pitch = Math.min(this.pitch, 64);
    this.canvas.style.height = `${Math.round(rows * this.pitch + 2 * this.margin)}px`;
    const { context } = fit(this.canvas);
    this.drawLinks(context, columns, rows);
    this.drawMessages(context);
    for (let node = 0; node < this.state.run.nodes; node++) this.drawNode(context, node);
  }

  /** Links between neighbours; their width shows the bytes that they carry in the whole run. */
  drawLinks(context, columns, rows) {
    if (!this.state.run.index.machine.mesh) return;
    const use = this.linkUse();
    const most = Math.max(1, ...use.values());
    context.strokeStyle = colourOf("faint");
    const at = (column, row) => [this.margin + (column + 0.5) * this.pitch, this.margin + (row + 0.5) * this.pitch];
    for (let row = 0; row < rows; row++) {
      for (let column = 0; column < columns; column++) {
        for (const [right, down] of [[1, 0], [0, 1]]) {
          if (column + right >= columns || row + down >= rows) continue;
          context.lineWidth = 0.7 + 5 * ((use.get(`${column},${row},${right}`) || 0) / most);
          context.beginPath();
          context.moveTo(...at(column, row));
          context.lineTo(...at(column + right, row + down));
          context.stroke();
        }
      }
    }
  }

  /** Bytes over each link in the whole run, both directions together. */
  linkUse() {
    const { run } = this.state;
    if (run.linkUse) return run.linkUse;
    const use = new Map();
    const { from, to, bytes } = run.messages;
    const between = new Map();
    for (let i = 0; i < from.length; i++) {
      const key = from[i] * run.nodes + to[i];
      between.set(key, (between.get(key) || 0) + bytes[i]);
    }
    for (const [key, sum] of between) {
      const route = this.route(Math.floor(key / run.nodes), key % run.nodes);
      for (let i = 1; i < route.length; i++) {
        const [a, b] = [route[i - 1], route[i]];
        const link = `${Math.min(a[0], b[0])},${Math.min(a[1], b[1])},${a[1] === b[1] ? 1 : 0}`;
        use.set(link, (use.get(link) || 0) + sum);
      }
    }
    return (run.linkUse = use);
  }

  /** The routers on a message's way, along the row first, as columns and rows on the canvas. */
  route(from, to) {
    const { width, height, places } = this.state.run.index.machine;
    const turned = height > width;
    const at = (place) => [place % width, Math.floor(place / width)];
    const [[x, y], [tx, ty]] = [at(places[from]), at(places[to])];
    const path = [[x, y]];
    for (let i = x; i !== tx; path.push([i, y])) i += Math.sign(tx - i);
    for (let i = y; i !== ty; path.push([tx, i])) i += Math.sign(ty - i);
    return turned ? path.map(([a, b]) => [b, a]) : path;
  }

  /** Messages under way as dots, and messages that have just arrived as fading lines. */
  drawMessages(context) {
    const { run, time, window: [start, stop] } = this.state;
    const { sent, arrived, from, to, kind } = run.messages;
    const trace = (stop - start) * FADE;
    const isMesh = run.index.machine.mesh;
    const last = upperBound(sent, time);
    const first = Math.max(upperBound(sent, time - run.longestFlight - trace), last - 400);
    for (let i = first; i < last; i++) {
      const age = time - arrived[i];
      if (age > trace) continue;
      const points = isMesh
        ? this.route(from[i], to[i]).map(([c, r]) => [this.margin + (c + 0.5) * this.pitch, this.margin + (r + 0.5) * this.pitch])
        : [this.place(from[i]), this.place(to[i])];
      context.globalAlpha = age > 0 ? 0.9 * (1 - age / trace) : 1;
      context.strokeStyle = context.fillStyle = colourOf(kind[i] === SOURCE ? "received" : kind[i] === TOKEN ? "token" : "overhead");
      context.lineWidth = kind[i] === SOURCE ? 2.5 : 1;
      context.beginPath();
      points.forEach((point, n) => (n ? context.lineTo(...point) : context.moveTo(...point)));
      context.stroke();
      if (age > 0) continue;
      const way = ((time - sent[i]) / Math.max(arrived[i] - sent[i], 1e-12)) * (points.length - 1);
      const [a, b] = [points[Math.floor(way)], points[Math.min(points.length - 1, Math.floor(way) + 1)]];
      context.beginPath();
      context.arc(a[0] + (way % 1) * (b[0] - a[0]), a[1] + (way % 1) * (b[1] - a[1]), 4, 0, 7);
      context.fill();
    }
    context.globalAlpha = 1;
  }

  /** A node: its state (colour), the share of the time it computed (bar), the length of its queue (number). */
  drawNode(context, node) {
    const { run, time } = this.state;
    const [x, y] = this.place(node);
    const half = this.pitch * 0.36;
    const span = run.spanAt(node, time);
    context.fillStyle = colourOf(span < 0 ? "waiting" : NODE_STATES[run.spans.states[span]].key);
    context.fillRect(x - half, y - half, 2 * half, 2 * half);
    context.strokeStyle = colourOf(node === this.state.node ? "accent" : "faint");
    context.lineWidth = node === this.state.node ? 2.5 : 1;
    context.strokeRect(x - half, y - half, 2 * half, 2 * half);
    context.fillStyle = colourOf("text");
    if (time > 0) context.fillRect(x - half, y + half - 3, 2 * half * (run.busyUntil(node, time) / time), 3);
    if (this.pitch < 16) return;
    const { queue } = run.queueAt(node, time);
    const text = node === run.computeNodes ? "H" : queue > 0 ? String(queue) : "";
    context.font = `600 ${Math.round(Math.min(13, this.pitch * 0.42))}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.fillStyle = span < 0 ? colourOf("text") : colourOf("on-colour");
    context.fillText(text, x, y + 3);
  }

  click(event) {
    const { run } = this.state;
    if (!run) return;
    const away = (node) => {
      const [x, y] = this.place(node);
      return Math.max(Math.abs(x - event.offsetX), Math.abs(y - event.offsetY));
    };
    const near = Array.from({ length: run.computeNodes }, (_, node) => node).find((node) => away(node) < this.pitch / 2);
    this.state.set({ selection: near === undefined ? { kind: "scene" } : { kind: "processor", number: near } });
  }
}
