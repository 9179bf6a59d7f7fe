// The viewer of a page that follows runs while they are under way.

const MOST_SHARE = 0.3; // of the browser's time, for showing updates

class LiveViewer extends Viewer {
  constructor(index) {
    super(index);
    this.playing = true;
    byId("viewer-title").textContent = "Runs under way";
    byId("quality").closest("figure").hidden = true;
    byId("energy").closest("figure").className = "panel wide-panel";
    byId("critical").closest("label").hidden = true;
    byId("colour").querySelector("[value=missing]").remove();
    this.showButton();
    this.connect("");
  }

  /** Follows one run (`?run=N`) or, without a query, any run under way. */
  connect(query) {
    this.source?.close();
    this.selected = query !== "";
    this.detached = false;
    // Parts are unpacked in order.
    this.work = Promise.resolve();
    const source = (this.source = new EventSource(this.index.updates + query));
    const on = (name, act) =>
      source.addEventListener(name, ({ data }) => {
        this.work = this.work.then(() => this.source === source && act(data)).catch((error) => this.say(error.message));
      });
    on("runs", (data) => this.showRuns(JSON.parse(data)));
    on("begin", (data) => this.begin(Number(data)));
    on("part", (data) => this.part(data));
    on("cut", () => this.say("This run is too large for the page to follow further: what is shown stops before its end."));
    on("end", (data) => this.ended(Number(data)));
    source.addEventListener("finished", () => this.finished().catch((error) => this.say(error.message)));
    source.addEventListener("error", () => this.say("No connection to the simulation. What is shown is what was received so far."));
  }

  async begin(number) {
    if (this.detached) return;
    this.live = new LiveRun(this.index.runs[number], await this.scene(this.index.runs[number].scene));
    this.number = number;
    byId("run").value = String(number);
    byId("viewer").dataset.ready = number;
    delete byId("viewer").dataset.ended;
    this.shown = false;
  }

  async part(data) {
    if (this.detached) return;
    this.live.add(await inflate(data));
    this.show();
  }

  /** Shows what is new, but not so often that it takes most of the browser's time. */
  show() {
    if (this.pending) return;
    this.pending = true;
    setTimeout(() => {
      this.pending = false;
      const began = performance.now();
      this.grow();
      this.rest = (performance.now() - began) / MOST_SHARE;
    }, this.rest || 0);
  }

  /** Shows the run with its new parts, at its new end unless the page is paused. */
  grow() {
    const { state, live } = this;
    if (!(live.end > 0)) return;
    live.layOut();
    if (!this.shown) {
      this.shown = true;
      return state.open(live);
    }
    if (!this.playing) return state.set({ grown: true });
    const [from, to] = state.window;
    const fields = { grown: true, time: live.end };
    // A timeline that showed the whole run goes on showing it.
    if (from === 0 && to >= state.time) fields.window = [0, live.end];
    state.set(state.light.goTo(live.end) ? { ...fields, light: state.light } : fields);
  }

  ended(number) {
    if (this.detached) return;
    this.grow();
    byId("viewer").dataset.ended = number;
    // A paused page keeps the run that it shows.
    if (!this.playing) this.detached = true;
    else if (this.selected) this.connect("");
  }

  /** All runs have ended, and the server now has the report. It is fetched at once, since the server may stop soon. */
  async finished() {
    this.source.close();
    this.report = await (await fetch("")).text();
    if (this.playing) return this.toReport();
    await this.work;
    this.say("All runs have ended. Press Live to see the report.");
  }

  /** Replaces the page by the report. */
  toReport() {
    document.open();
    document.write(this.report);
    document.close();
  }

  showRuns({ ended, under_way }) {
    this.say(
      `Under way: ${under_way.length} of ${count(this.index.runs.length, "run")}, ${ended} ended. ` +
      "The page shows what has happened so far. When all runs have ended, it becomes the report.");
    for (const option of byId("run").options) {
      option.disabled = !under_way.includes(Number(option.value)) && Number(option.value) !== this.number;
    }
  }

  say(text) {
    byId("sampled").textContent = text;
  }

  showButton() {
    byId("play").textContent = this.playing ? "Pause" : "Live";
    byId("play").setAttribute("aria-pressed", !this.playing);
  }

  /** Follows a selected run from its beginning. */
  async open(number) {
    this.playing = true;
    this.showButton();
    this.connect(`?run=${number}`);
  }

  async siblings(run) {
    return [run];
  }

  update(names) {
    super.update(names.has("grown") ? new Set([...names, "time"]) : names);
    // Going back in time pauses.
    if (this.playing && names.has("time") && this.state.time < this.state.run.end) this.play(false);
  }

  /** Follows the run, or pauses the page; the simulation goes on either way. */
  play(on) {
    if (this.report) return this.toReport();
    this.playing = on;
    this.showButton();
    if (!on || !this.state.run) return;
    if (this.detached) this.connect("");
    else this.state.goTo(this.state.run.end);
  }
}

const viewerIndex = JSON.parse(byId("viewer-index").textContent);
byId("viewer").hidden = false;
byId("sampled").textContent = "Waiting for the first run.";
new LiveViewer(viewerIndex);
