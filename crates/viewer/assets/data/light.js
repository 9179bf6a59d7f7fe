// The light at any instant of a run: what patches emit, and what every shot that has ended has added.

class Light {
  /** With `last`, a radiosity to compare with, it also follows the distance from it. */
  constructor(run, last = null) {
    Object.assign(this, { run, last });
    this.emission = run.scene.emission();
    this.radiosity = new Float32Array(this.emission.length);
    this.emitted = 0;
    this.missingAtFirst = 0;
    run.scene.areas.forEach((area, patch) => {
      for (let i = 3 * patch; i < 3 * patch + 3; i++) {
        this.emitted += this.emission[i] * area;
        if (last) this.missingAtFirst += area * (last[i] - this.emission[i]) ** 2;
      }
    });
    this.restart();
  }

  restart() {
    this.radiosity.set(this.emission);
    this.missing = this.missingAtFirst;
    this.done = 0;
    this.energy = { absorbed: 0, transit: 0, unshot: this.emitted, escaped: 0, medium: 0 };
  }

  /** Root mean square over the area of the distance from `last`, relative to its value at the start. */
  get distance() {
    return this.missingAtFirst > 0 ? Math.sqrt(Math.max(0, this.missing) / this.missingAtFirst) : 0;
  }

  /** Goes to a time, forwards or back; returns whether anything has changed. */
  goTo(time) {
    const target = upperBound(this.run.shotEnds, time);
    if (target === this.done) return false;
    if (target < this.done) this.restart();
    while (this.done < target) this.receive(this.run.shots[this.done++]);
    return true;
  }

  /** RR-3008, section 4.2.3: a shot updates the radiosities of the patches that it hits. */
  receive(span) {
    const { last, run: { scene, spans } } = this;
    const { unit, starts, patches, weights, environments, backs, escaped, medium, outgoing } = scene.shots;
    const shot = spans.shot[span];
    const power = spans.powers.subarray(3 * spans.emitter[span], 3 * spans.emitter[span] + 3);
    const first = scene.patchStarts[environments[shot]];
    const sum = power[0] + power[1] + power[2];
    const energy = this.energy;
    let [arriving, reflected] = [0, 0];
    for (let hit = starts[shot]; hit < starts[shot + 1]; hit++) {
      const patch = first + patches[hit];
      const [formFactor, material, area] = [weights[hit] * unit, scene.material(patch), scene.areas[patch]];
      arriving += formFactor;
      for (let colour = 0; colour < 3; colour++) {
        const leaving = power[colour] * formFactor * material[colour];
        reflected += leaving;
        const i = 3 * patch + colour;
        const before = this.radiosity[i];
        this.radiosity[i] += leaving / area;
        if (last) this.missing += area * ((last[i] - this.radiosity[i]) ** 2 - (last[i] - before) ** 2);
      }
    }
    const local = spans.states[span] === LOCAL;
    const all = arriving + (backs[shot] + escaped[shot] + medium[shot] + outgoing[shot]) * unit;
    energy[local ? "unshot" : "transit"] -= sum * (local ? 1 : all);
    energy.unshot += reflected;
    energy.absorbed += sum * (arriving + backs[shot] * unit) - reflected;
    energy.escaped += sum * escaped[shot] * unit;
    energy.medium += sum * medium[shot] * unit;
    energy.transit += sum * outgoing[shot] * unit;
  }
}

/** The radiosity at the end of a run. */
function lastLight(run) {
  const light = new Light(run);
  light.goTo(Infinity);
  return light.radiosity;
}

/** Distance and energy of a run at `count` equal times and at its end. */
function history(run, count) {
  const light = new Light(run, run.scene.reference || lastLight(run));
  return Array.from({ length: count + 1 }, (_, i) => {
    const time = (run.end * i) / count;
    light.goTo(time);
    return { time, distance: light.distance, ...light.energy };
  });
}
