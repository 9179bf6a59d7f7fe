// A page that follows runs while they are under way.

const MOST_SHARE = 0.3; // of the browser's time, for what is new

class LiveViewer extends Viewer {
  constructor(index) {
    super(index);
    this.playing = true;
    byId("viewer-title").textContent = "Runs under way";
    byId("quality").closest("figure").hidden = true;
    byId("energy").closest("figure").className = "panel wide-panel";
    byId("critical").closest("label").hidden = true;
    byId("colour").querySelector("[value=missing]").remove();
    this.tellButton();
    this.connect("");
  }

  /** Follows one run, or whichever is under way. */
  connect(query) {
    this.source?.close();
    this.chosen = query !== "";
    this.deaf = false;
    // Parts are unpacked one after the other.
    this.work = Promise.resolve();
    const source = (this.source = new EventSource(this.index.updates + query));
    const on = (name, act) =>
      source.addEventListener(name, ({ data }) => {
        this.work = this.work.then(() => this.source === source && act(data)).catch((error) => this.say(error.message));
      });
    on("runs", (data) => this.tellRuns(JSON.parse(data)));
    on("begin", (data) => this.begin(Number(data)));
    on("part", (data) => this.part(data));
    on("cut", () => this.say("This run is too large to be followed further here: what is shown ends before it does."));
    on("end", (data) => this.ended(Number(data)));
    source.addEventListener("finished", () => this.finished().catch((error) => this.say(error.message)));
    source.addEventListener("error", () => this.say("No connection to the simulation. What is shown is what it has told so far."));
  }

  async begin(number) {
    if (this.deaf) return;
    this.live = new LiveRun(this.index.runs[number], await this.scene(this.index.runs[number].scene));
    this.number = number;
    byId("run").value = String(number);
    byId("viewer").dataset.ready = number;
    delete byId("viewer").dataset.ended;
    this.shown = false;
  }

  async part(data) {
    if (this.deaf) return;
    this.live.add(await inflate(data));
    this.show();
  }

  /** Shows what is new, unless more has come meanwhile and it takes long. */
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

  /** The run has grown; whoever looks at its last instant goes on with it. */
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
    // All of the run stays in sight if it was.
    if (from === 0 && to >= state.time) fields.window = [0, live.end];
    state.set(state.light.goTo(live.end) ? { ...fields, light: state.light } : fields);
  }

  ended(number) {
    if (this.deaf) return;
    byId("viewer").dataset.ended = number;
    this.show();
    // What stands still stays, whatever else begins.
    if (!this.playing) this.deaf = true;
    else if (this.chosen) this.connect("");
  }

  /** What is served now is the report: it is fetched at once, since nobody knows for how long. */
  async finished() {
    this.source.close();
    this.report = await (await fetch("")).text();
    if (this.playing) return this.toReport();
    await this.work;
    this.say("All runs have ended. Press Live to see the report.");
  }

  /** The page becomes the report. */
  toReport() {
    document.open();
    document.write(this.report);
    document.close();
  }

  tellRuns({ ended, under_way }) {
    this.say(
      `Under way: ${under_way.length} of ${count(this.index.runs.length, "run")}, ${ended} ended. ` +
      "What is shown is what has happened so far; the page becomes the report when all have ended.");
    for (const option of byId("run").options) {
      option.disabled = !under_way.includes(Number(option.value)) && Number(option.value) !== this.number;
    }
  }

  say(text) {
    byId("sampled").textContent = text;
  }

  tellButton() {
    byId("play").textContent = this.playing ? "Pause" : "Live";
    byId("play").setAttribute("aria-pressed", !this.playing);
  }

  /** The run that is chosen, from its beginning. */
  async open(number) {
    this.playing = true;
    this.tellButton();
    this.connect(`?run=${number}`);
  }

  async siblings(run) {
    return [run];
  }

  update(names) {
    super.update(names.has("grown") ? new Set([...names, "time"]) : names);
    // Whoever goes back in time stays there.
    if (this.playing && names.has("time") && this.state.time < this.state.run.end) this.play(false);
  }

  /** The page goes on, or stands still; the simulation knows nothing of it. */
  play(on) {
    if (this.report) return this.toReport();
    this.playing = on;
    this.tellButton();
    if (!on || !this.state.run) return;
    if (this.deaf) this.connect("");
    else this.state.goTo(this.state.run.end);
  }
}

const viewerIndex = JSON.parse(byId("viewer-index").textContent);
byId("viewer").hidden = false;
byId("sampled").textContent = "Waiting for the first run.";
new LiveViewer(viewerIndex);
