// The table of all nodes at the shown time.

class NodeTable {
  constructor(state) {
    this.state = state;
    state.onChange((names) => {
      if (names.has("time") || names.has("run")) this.fill();
    });
    byId("node-details").addEventListener("toggle", () => this.fill());
  }

  /** Fills the table, if it is open. */
  fill() {
    const { run, time } = this.state;
    if (!run || !byId("node-details").open) return;
    const rows = Array.from({ length: run.computeNodes }, (_, node) => {
      const span = run.spanAt(node, time);
      const { queue, memory } = run.queueAt(node, time);
      const share = time > 0 ? (100 * run.busyUntil(node, time)) / time : 0;
      const [from, to] = [run.spans.starts[node], run.spans.starts[node + 1]];
      const shots = [0, 0];
      for (let i = from; i < to && run.spans.to[i] <= time; i++) if (run.spans.states[i] <= RECEIVED) shots[run.spans.states[i]]++;
      const state = span < 0 ? "waiting" : NODE_STATES[run.spans.states[span]].name;
      return [node, state, `${share.toFixed(1)} %`, queue, memory ? bytes(memory) : "–", ...shots];
    });
    byId("nodes").tBodies[0].replaceChildren(...rows.map((cells) => {
      const row = document.createElement("tr");
      cells.forEach((cell, i) => {
        const field = row.insertCell();
        field.textContent = cell;
        if (i === 1) field.className = "text";
      });
      return row;
    }));
  }
}
