// What the page shows: a run, a time, a selection. The panels listen for changes.

class State {
  constructor() {
    this.listeners = [];
    Object.assign(this, { run: null, light: null, time: 0, selection: { kind: "scene" }, window: [0, 1] });
  }

  onChange(listener) {
    this.listeners.push(listener);
  }

  /** Changes some fields and passes their names to the listeners. */
  set(fields) {
    Object.assign(this, fields);
    const names = new Set(Object.keys(fields));
    this.listeners.forEach((listener) => listener(names));
  }

  /** Shows the end of a run. What was selected in the same scene stays selected. */
  open(run) {
    const light = new Light(run);
    light.goTo(run.end);
    const fields = { run, light, time: run.end, window: [0, run.end] };
    const same = this.run?.scene.corners === run.scene.corners && this.selection.kind !== "processor";
    this.set(same ? fields : { ...fields, selection: { kind: "scene" } });
  }

  goTo(wanted) {
    const time = Math.max(0, Math.min(wanted, this.run.end));
    const { light } = this;
    this.set(light.goTo(time) ? { time, light } : { time });
  }

  /** The selected environments. */
  get environments() {
    const { kind, number } = this.selection;
    if (kind === "environment") return [number];
    if (kind === "processor") return this.run.environmentsOf(number);
    return Array.from({ length: this.run.scene.environments }, (_, i) => i);
  }

  /** The selected node, or that of the selected environment, or -1. */
  get node() {
    const { kind, number } = this.selection;
    if (kind === "environment") return this.run.owners[number];
    return kind === "processor" ? number : -1;
  }

  /** The name of what is selected. */
  get selectionName() {
    const { kind, number } = this.selection;
    if (kind === "scene") return this.run.scene.name;
    return `${kind} ${number}`;
  }
}
