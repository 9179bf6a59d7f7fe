// Charts of energy and of the distance from the final light over time, as SVG.

/** Size and margins of a chart, pixels; the width follows the page's. */
const FRAME = { width: 560, height: 250, left: 54, right: 78, top: 12, bottom: 34 };
const ENERGY = [
  ["absorbed", "absorbed"], ["transit", "in transit"], ["unshot", "unshot"], ["escaped", "escaped"],
  ["medium", "absorbed by media"],
];
const QUALITY_FLOOR = 1e-3;

class Charts {
  constructor(state, viewer) {
    Object.assign(this, { state, viewer, histories: new Map() });
    state.onChange((names) => {
      if (names.has("run")) this.redraw();
      else if (names.has("grown")) this.drawEnergy();
      if (names.has("time")) this.moveCursors();
      if (names.has("light")) this.showBalance();
    });
    new ResizeObserver(() => {
      if (state.run && byId("energy").clientWidth !== FRAME.width) this.redraw();
    }).observe(byId("energy").parentElement);
    for (const id of ["energy", "quality"]) byId(id).addEventListener("click", (event) => this.click(event));
  }

  /** A run's history, computed once; a run under way has its own. */
  history(run) {
    if (run.history) return run.history;
    if (!this.histories.has(run.index)) this.histories.set(run.index, history(run, 400));
    return this.histories.get(run.index);
  }

  redraw() {
    FRAME.width = Math.max(280, byId("energy").clientWidth);
    this.drawEnergy();
    const { run } = this.state;
    if (run.history) return;
    this.drawQuality([run]);
    // The other runs of its group are added when they are loaded.
    this.viewer.siblings(run).then((runs) => {
      if (this.state.run === run) this.drawQuality(runs);
    });
  }

  drawEnergy() {
    const { run } = this.state;
    const samples = this.history(run);
    const first = samples[0];
    const whole = first.unshot || 1;
    const x = scale(0, run.end, FRAME.left, FRAME.width - FRAME.right);
    const y = scale(0, 1, FRAME.height - FRAME.bottom, FRAME.top);
    const parts = axes(x, y, [0, 0.25, 0.5, 0.75, 1].map((v) => [v, `${100 * v} %`]), run.end);
    const floor = samples.map(() => 0);
    for (const [key, name] of ENERGY) {
      const below = samples.map((sample, i) => point(x(sample.time), y(floor[i])));
      samples.forEach((sample, i) => (floor[i] += sample[key] / whole));
      const above = samples.map((sample, i) => point(x(sample.time), y(floor[i])));
      parts.push(`<path d="M${above.join("L")}L${below.reverse().join("L")}Z" fill="var(--energy-${key})"/>`);
      const last = samples[samples.length - 1][key] / whole;
      if (last > 0.02) {
        const at = y(floor[floor.length - 1] - last / 2) + 4;
        parts.push(`<text x="${FRAME.width - FRAME.right + 6}" y="${at}">${name}</text>`);
      }
    }
    const end = samples[samples.length - 1];
    const shares = ENERGY.map(([key, name]) => `${name} ${(100 * end[key] / whole).toFixed(1)} %`).join(", ");
    show(byId("energy"), parts, `Energy over time. At the end: ${shares}.`);
  }

  drawQuality(runs) {
    const shown = [...runs].sort((a, b) => a.computeNodes - b.computeNodes);
    const longest = Math.max(...shown.map((run) => run.end));
    const shortest = Math.min(...shown.map((run) => run.end)) / 30;
    const x = logScale(shortest, longest, FRAME.left, FRAME.width - FRAME.right);
    const y = logScale(QUALITY_FLOOR, 1, FRAME.height - FRAME.bottom, FRAME.top);
    const ticks = [0.001, 0.01, 0.1, 1].map((v) => [v, `${100 * v} %`]);
    const parts = axes(x, y, ticks, longest, shortest);
    const names = [];
    shown.forEach((run, i) => {
      const samples = this.history(run).filter(({ time }) => time >= shortest);
      const steps = [];
      for (const { time, distance } of samples) {
        const [px, py] = [x(time), y(Math.max(distance, QUALITY_FLOOR))];
        steps.push(steps.length ? `H${px.toFixed(1)}V${py.toFixed(1)}` : `M${point(px, py)}`);
        if (distance < QUALITY_FLOOR) break;
      }
      const here = run === this.state.run;
      const colour = `var(--series-${i % 6})`;
      parts.push(`<path d="${steps.join("")}" fill="none" stroke="${colour}" stroke-width="${here ? 3 : 1.4}"/>`);
      const height = y(0.002 * 2 ** (i % 4)) + 4;
      names.push(`<text class="name" x="${x(run.end) + 3}" y="${height}">${run.computeNodes}</text>`);
    });
    parts.push(...names);
    const words = shown.map((run) => {
      const tenth = this.history(run).find(({ distance }) => distance < 0.1);
      return `${run.computeNodes} processors ${seconds(tenth ? tenth.time : run.end)}`;
    });
    byId("quality-note").textContent = `${shown[0].scene.reference ? "Distance from the reference" : "Distance from the run's final light"}, relative to its value at the start (root mean square over the area), against virtual time. The numbers are processors.`;
    show(byId("quality"), parts, `Time to within 10 % of the final light: ${words.join(", ")}.`);
    this.qualityScale = x;
    this.moveCursors();
  }

  moveCursors() {
    const { run, time } = this.state;
    const x = scale(0, run.end, FRAME.left, FRAME.width - FRAME.right);
    cursor(byId("energy"), x(time));
    if (this.qualityScale) cursor(byId("quality"), this.qualityScale(Math.max(time, 1e-9)));
  }

  /** The energy balance in numbers: the parts add up to what was emitted. */
  showBalance() {
    const { energy, emitted } = this.state.light;
    const share = (value, digits) => `${Math.abs((100 * value) / (emitted || 1)).toFixed(digits)} %`;
    const sum = ENERGY.reduce((all, [key]) => all + energy[key], 0);
    const parts = ENERGY.filter(([key]) => key !== "medium" || energy.medium > 0);
    const shown = parts.map(([key, name]) => `${name} ${share(energy[key], 1)}`);
    byId("balance").textContent =
      `${shown.join(", ")}; together ${share(sum, 4)} of what is emitted.`;
  }

  click(event) {
    const box = event.currentTarget.getBoundingClientRect();
    const px = ((event.clientX - box.left) / box.width) * FRAME.width;
    const share = (px - FRAME.left) / (FRAME.width - FRAME.right - FRAME.left);
    if (event.currentTarget.id === "energy") return this.state.goTo(share * this.state.run.end);
    this.state.goTo(this.qualityScale.back(px));
  }
}

const point = (x, y) => `${x.toFixed(1)},${y.toFixed(1)}`;

function scale(from, to, start, stop) {
  return (value) => start + ((value - from) / (to - from || 1)) * (stop - start);
}

function logScale(from, to, start, stop) {
  const map = (value) => start + (Math.log(Math.max(value, from) / from) / Math.log(to / from)) * (stop - start);
  map.logarithmic = [from, to];
  map.back = (x) => from * (to / from) ** ((x - start) / (stop - start));
  return map;
}

function axes(x, y, ticks, end) {
  const parts = [];
  const [left, right, floor] = [FRAME.left, FRAME.width - FRAME.right, FRAME.height - FRAME.bottom];
  for (const [value, name] of ticks) {
    parts.push(`<path class="grid" d="M${left},${y(value)}H${right}"/>`,
      `<text x="${left - 6}" y="${y(value) + 4}" text-anchor="end">${name}</text>`);
  }
  let times = [];
  if (x.logarithmic) {
    for (let power = Math.ceil(Math.log10(x.logarithmic[0])); 10 ** power <= end; power++) times.push(10 ** power);
  } else {
    const step = roundStep(end / 5);
    for (let time = 0; time <= end; time += step) times.push(time);
  }
  for (const time of times) {
    const text = time >= 1e4 ? time.toExponential(0) : String(Number(time.toPrecision(3)));
    parts.push(`<path class="grid" d="M${x(time)},${floor}v5"/>`,
      `<text x="${x(time)}" y="${floor + 18}" text-anchor="middle">${text}</text>`);
  }
  parts.push(`<text x="${right}" y="${floor + 31}" text-anchor="end">virtual time, s</text>`);
  return parts;
}

function show(svg, parts, label) {
  svg.setAttribute("viewBox", `0 0 ${FRAME.width} ${FRAME.height}`);
  svg.setAttribute("aria-label", label);
  svg.innerHTML = parts.join("") + `<path class="now" d="M0,${FRAME.top}V${FRAME.height - FRAME.bottom}"/>`;
}

function cursor(svg, x) {
  svg.querySelector(".now")?.setAttribute("transform", `translate(${x},0)`);
}
