// The viewer: loads runs, and controls the time with a slider and a play button.

const PLAY_SECONDS = 20; // for the time that the timeline shows

class Viewer {
  constructor(index) {
    this.index = index;
    this.scenes = new Map();
    this.runs = new Map();
    this.state = new State();
    new LightPanel(this.state);
    new Tree(this.state);
    new MachinePanel(this.state);
    new Timeline(this.state);
    new Charts(this.state, this);
    new NodeTable(this.state);
    this.state.onChange((names) => this.update(names));
    this.controls();
  }

  controls() {
    const { state } = this;
    const select = byId("run");
    this.index.runs.forEach((run, i) => select.add(new Option(run.label, i)));
    select.value = String(this.index.first);
    select.addEventListener("change", () => this.open(Number(select.value)));
    byId("time").addEventListener("input", (event) => state.goTo((event.target.value / 1000) * state.run.end));
    byId("play").addEventListener("click", () => this.play(!this.playing));
    byId("previous").addEventListener("click", () => this.jump(-1));
    byId("next").addEventListener("click", () => this.jump(1));
    byId("viewer").addEventListener("keydown", (event) => {
      const free = !["BUTTON", "SELECT", "INPUT", "SUMMARY"].includes(event.target.tagName);
      if (event.key === " " && free) {
        event.preventDefault();
        this.play(!this.playing);
      }
    });
  }

  async scene(number) {
    if (!this.scenes.has(number)) this.scenes.set(number, Scene.load(this.index.scenes[number]));
    return this.scenes.get(number);
  }

  async run(number) {
    if (!this.runs.has(number)) {
      const index = this.index.runs[number];
      this.runs.set(number, this.scene(index.scene).then((scene) => Run.load(index, scene)));
    }
    return this.runs.get(number);
  }

  /** All runs that differ from this one only in the number of processors, loaded one by one. */
  async siblings(run) {
    const runs = [];
    for (let i = 0; i < this.index.runs.length; i++) {
      if (this.index.runs[i].group !== run.index.group) continue;
      await new Promise((done) => setTimeout(done, 20));
      runs.push(await this.run(i));
    }
    return runs;
  }

  async open(number) {
    this.play(false);
    const run = await this.run(number);
    if (Number(byId("run").value) !== number) return;
    this.state.open(run);
    byId("viewer").dataset.ready = number;
  }

  update(names) {
    const { state } = this;
    if (!["time", "selection", "window"].some((name) => names.has(name))) return;
    const { run, time, window: [from, to] } = state;
    const slider = byId("time");
    if (document.activeElement !== slider || Math.abs(slider.value - (1000 * time) / run.end) >= 1) {
      slider.value = Math.round((1000 * time) / run.end);
    }
    const text = `${seconds(time, (to - from) / 1e4)} of ${seconds(run.end, run.end / 1e4)}`;
    slider.setAttribute("aria-valuetext", text);
    byId("clock").textContent = text;
    byId("status").textContent = this.status();
  }

  status() {
    const { run, time, selectionName } = this.state;
    let [local, received, busy] = [0, 0, 0];
    const done = upperBound(run.shotEnds, time);
    for (let i = 0; i < done; i++) run.spans.states[run.shots[i]] === LOCAL ? local++ : received++;
    for (let node = 0; node < run.computeNodes; node++) busy += run.busyUntil(node, time);
    const share = time > 0 ? (100 * busy) / (run.computeNodes * time) : 0;
    return `Shown: ${selectionName}. Until now ${count(local, "local shot")}, ${count(received, "received shot")}; ` +
      `nodes computed ${share.toFixed(1)} % of the time.`;
  }

  /** To the end of the previous (`by` -1) or next (1) shot. */
  jump(by) {
    const { state } = this;
    const { run } = state;
    let at = upperBound(run.shotEnds, state.time) + (by > 0 ? 0 : -1);
    if (by < 0 && run.shotEnds[at] === state.time) at--;
    if (at < 0) return state.goTo(0);
    state.goTo(at < run.shotEnds.length ? run.shotEnds[at] : run.end);
  }

  play(on) {
    this.playing = on;
    byId("play").setAttribute("aria-pressed", on);
    byId("play").textContent = on ? "Pause" : "Play";
    byId("status").setAttribute("aria-live", on ? "off" : "polite");
    if (!on) return;
    const { state } = this;
    if (state.time >= state.run.end) state.goTo(state.window[0]);
    let last = performance.now();
    const frame = (now) => {
      if (!this.playing) return;
      const pace = (state.window[1] - state.window[0]) / PLAY_SECONDS;
      state.goTo(state.time + (pace * (now - last)) / 1000);
      last = now;
      if (state.time >= state.run.end) return this.play(false);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }
}
