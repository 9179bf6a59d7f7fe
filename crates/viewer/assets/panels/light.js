// The panel of the 3D view: which part of the scene it shows, in which colours.

class LightPanel {
  constructor(state) {
    this.state = state;
    this.canvas = byId("picture");
    this.pictures = new Map();
    state.onChange((names) => this.update(names));
    for (const id of ["colour", "tone", "exposure", "ceiling", "smooth", "boxes"]) {
      byId(id).addEventListener("input", () => this.repaint());
    }
    byId("walk").addEventListener("click", () => this.walk(!this.camera.walking));
    byId("home").addEventListener("click", () => this.home());
    new ResizeObserver(() => this.redraw()).observe(this.canvas);
    steer(this);
  }

  update(names) {
    if (!this.state.run || this.broken) return;
    try {
      if (names.has("run")) this.open();
      if (names.has("selection")) this.look();
      if (names.has("grown")) this.middle = middleGrey(this.state.run.scene, this.state.light.radiosity);
      if (names.has("light")) this.repaint();
      else if (names.has("selection")) this.redraw();
    } catch (error) {
      this.broken = true;
      byId("picture-note").textContent = `No picture: ${error.message}.`;
    }
  }

  /** Shows another run, possibly of the same scene. */
  open() {
    const { run } = this.state;
    if (this.picture?.scene.corners !== run.scene.corners) {
      if (this.picture) this.replaceCanvas();
      this.picture = new Picture(this.canvas, run.scene);
      this.camera = new Camera(run.scene);
      this.palette();
    }
    this.last = lastLight(run);
    this.middle = middleGrey(run.scene, this.last);
    byId("colour").querySelector("[value=error]").hidden = !run.scene.reference;
    if (!run.scene.reference && byId("colour").value === "error") byId("colour").value = "light";
  }

  /** A WebGL context holds one scene: another scene gets a new canvas. */
  replaceCanvas() {
    const fresh = this.canvas.cloneNode();
    this.canvas.replaceWith(fresh);
    this.picture.gl.getExtension("WEBGL_lose_context")?.loseContext();
    this.canvas = fresh;
    steer(this);
    new ResizeObserver(() => this.redraw()).observe(fresh);
  }

  palette() {
    const { environments } = this.state.run.scene;
    this.hues = Array.from({ length: Math.max(environments, 1) }, (_, i) => hue(i));
  }

  /** Points the camera at what is selected. */
  look() {
    const { run, selection, environments } = this.state;
    if (selection.kind === "scene") return this.camera.reset();
    const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
    for (const environment of environments) {
      run.scene.boxes[environment].forEach((x, i) => (box[i] = i < 3 ? Math.min(box[i], x) : Math.max(box[i], x)));
    }
    this.camera.look(box);
    this.walk(false);
  }

  home() {
    this.camera.reset();
    this.walk(false);
  }

  walk(on) {
    if (on) this.camera.walk();
    else if (this.camera.walking) this.camera.orbit();
    byId("walk").setAttribute("aria-pressed", on);
    this.redraw();
  }

  /** Sets the colours and draws. */
  repaint() {
    if (!this.picture || this.broken) return;
    const { picture } = this;
    const { run, light } = this.state;
    const { low, high } = run.scene;
    const colour = byId("colour").value;
    const isLight = !["environment", "processor"].includes(colour);
    picture.smooth = byId("smooth").checked && isLight;
    picture.tone = colour === "light" ? Number(byId("tone").value) : isLight ? 2 : 3;
    picture.middle = this.middle / 2 ** Number(byId("exposure").value);
    const share = Number(byId("ceiling").value) / 100;
    picture.ceiling = share < 1 ? low[2] + share * (high[2] - low[2]) : Infinity;
    picture.paint(colour === "light" ? light.radiosity : this.colours(colour));
    this.showScale();
    this.redraw();
  }

  /** Shows what colours mean; `virtwall render --exposure` draws the same picture. The shader's false colours go from
   *  5 stops below middle grey to 4 above. */
  showScale() {
    const { tone, middle } = this.picture;
    const stops = (by) => (middle * 2 ** by).toPrecision(2);
    const grey = `Middle grey is ${Number(middle.toPrecision(5))} W/m².`;
    const heat = `From ${stops(-5)} W/m² (black) through blue, red and yellow to ${stops(4)} W/m² (white), logarithmic.`;
    byId("scale").textContent = [grey, grey, heat, ""][tone];
  }

  colours(kind) {
    const { scene, owners } = this.state.run;
    const values = new Float32Array(3 * scene.patches);
    if (kind === "missing" || kind === "error") {
      const { radiosity } = this.state.light;
      const answer = kind === "missing" ? this.last : scene.reference;
      return values.map((_, i) => Math.abs(answer[i] - radiosity[i]));
    }
    for (let environment = 0; environment < scene.environments; environment++) {
      const rgb = this.hues[kind === "processor" ? owners[environment] : environment];
      for (let patch = scene.patchStarts[environment]; patch < scene.patchStarts[environment + 1]; patch++) {
        values.set(rgb, 3 * patch);
      }
    }
    return values;
  }

  redraw() {
    if (!this.picture || this.broken || this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      const ratio = Math.min(window.devicePixelRatio || 1, 2);
      const { canvas, picture, state } = this;
      canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
      canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
      const selected = state.selection.kind === "scene" ? [] : state.environments;
      picture.draw(this.camera, state.environments, selected, byId("boxes").checked);
    });
  }

  /** Shows what is at a point of the canvas. */
  ask(x, y) {
    const ratio = this.canvas.width / this.canvas.clientWidth;
    const { state, picture } = this;
    const patch = picture.patchAt(Math.round(x * ratio), Math.round(y * ratio), this.camera, state.environments);
    this.redraw();
    if (patch < 0 || patch >= state.run.scene.patches) return (byId("picture-note").textContent = "");
    const environment = state.run.scene.environmentOf(patch);
    const rgb = Array.from(state.light.radiosity.subarray(3 * patch, 3 * patch + 3), (b) => b.toPrecision(3));
    byId("picture-note").textContent =
      `Patch ${patch - state.run.scene.patchStarts[environment]} of environment ${environment}, processor ` +
      `${state.run.owners[environment]}: radiosity ${rgb.join(", ")} W/m²`;
  }
}

/** A distinct colour for each number: hues spread by the golden ratio. */
function hue(number) {
  const h = (number * 0.618034) % 1;
  const light = 0.6 + 0.16 * (number % 3 - 1);
  const channel = (shift) => {
    const x = Math.abs(((h + shift) % 1) * 6 - 3) - 1;
    return light + (Math.max(0, Math.min(1, x)) - 0.5) * 0.55;
  };
  return [channel(0), channel(2 / 3), channel(1 / 3)];
}

/** The radiosity that becomes middle grey: as in the `radiosity` crate, over the area of all patches. */
function middleGrey(scene, light) {
  const eye = (patch) => 0.2126 * light[3 * patch] + 0.7152 * light[3 * patch + 1] + 0.0722 * light[3 * patch + 2];
  let [area, sum, logs] = [0, 0, 0];
  for (let patch = 0; patch < scene.patches; patch++) {
    area += scene.areas[patch];
    sum += scene.areas[patch] * eye(patch);
  }
  const least = (0.05 * sum) / area;
  if (!(least > 0)) return 1;
  for (let patch = 0; patch < scene.patches; patch++) {
    logs += scene.areas[patch] * Math.log(Math.max(eye(patch), least));
  }
  return Math.exp(logs / area);
}
