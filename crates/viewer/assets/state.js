// What the page shows: one run, one time, one choice; whoever shows any of it is told of changes.

class State {
  constructor() {
    this.listeners = [];
    Object.assign(this, { run: null, light: null, time: 0, choice: { kind: "scene" }, window: [0, 1] });
  }

  onChange(listener) {
    this.listeners.push(listener);
  }

  /** Changes some fields; listeners learn their names. */
  set(fields) {
    Object.assign(this, fields);
    const names = new Set(Object.keys(fields));
    this.listeners.forEach((listener) => listener(names));
  }

  /** Shows a run from its last instant; what was chosen of the scene stays so, if it is the same scene. */
  open(run) {
    const light = new Light(run);
    light.goTo(run.end);
    const fields = { run, light, time: run.end, window: [0, run.end] };
    const same = this.run?.scene.corners === run.scene.corners && this.choice.kind !== "processor";
    this.set(same ? fields : { ...fields, choice: { kind: "scene" } });
  }

  goTo(wanted) {
    const time = Math.max(0, Math.min(wanted, this.run.end));
    const { light } = this;
    this.set(light.goTo(time) ? { time, light } : { time });
  }

  /** The environments to be shown. */
  get environments() {
    const { kind, number } = this.choice;
    if (kind === "environment") return [number];
    if (kind === "processor") return this.run.environmentsOf(number);
    return Array.from({ length: this.run.scene.environments }, (_, i) => i);
  }

  /** The node that the choice is about, or -1. */
  get node() {
    const { kind, number } = this.choice;
    if (kind === "environment") return this.run.owners[number];
    return kind === "processor" ? number : -1;
  }

  /** What one may choose has a name. */
  get choiceName() {
    const { kind, number } = this.choice;
    if (kind === "scene") return this.run.scene.name;
    return `${kind} ${number}`;
  }
}

const byId = (id) => document.getElementById(id);

/** Seconds in words, as exactly as `step` seconds need it. */
function seconds(value, step = value / 1000) {
  const digits = step > 0 ? Math.max(0, Math.min(9, Math.ceil(-Math.log10(step)))) : 0;
  return `${value.toFixed(digits)} s`;
}

function bytes(count) {
  if (count < 1024) return `${count} B`;
  return count < 1048576 ? `${(count / 1024).toFixed(1)} KiB` : `${(count / 1048576).toFixed(1)} MiB`;
}

/** A colour of the style sheet. */
const ink = (name) => getComputedStyle(byId("viewer")).getPropertyValue(`--${name}`).trim();

/** Fits a canvas to its place on the screen; its context, in CSS pixels. */
function fit(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}
