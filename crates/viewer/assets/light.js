// Light at any instant: what was emitted, and what every shot that has ended has brought.

class Light {
  constructor(run) {
    this.run = run;
    this.emission = run.scene.emission();
    this.radiosity = new Float32Array(this.emission.length);
    this.emitted = 0;
    for (let patch = 0; patch < run.scene.patches; patch++) {
      const sum = this.emission[3 * patch] + this.emission[3 * patch + 1] + this.emission[3 * patch + 2];
      this.emitted += sum * run.scene.areas[patch];
    }
    this.restart();
  }

  restart() {
    this.radiosity.set(this.emission);
    this.done = 0;
    this.counts = { local: 0, received: 0 };
    this.energy = { absorbed: 0, unshot: this.emitted, transit: 0, escaped: 0 };
  }

  /** Goes to a time, forwards or back; says whether anything has changed. */
  goTo(time) {
    const target = upperBound(this.run.shotEnds, time);
    if (target === this.done) return false;
    if (target < this.done) this.restart();
    while (this.done < target) this.receive(this.run.shots[this.done++]);
    return true;
  }

  /** §4.2.3: a shot updates the radiosities of the patches that it hits. */
  receive(span) {
    const { scene, spans } = this.run;
    const { unit, starts, patches, weights, environments, backs, escaped, outgoing } = scene.shots;
    const shot = spans.shot[span];
    const power = spans.powers.subarray(3 * spans.source[span], 3 * spans.source[span] + 3);
    const first = scene.patchStarts[environments[shot]];
    const sum = power[0] + power[1] + power[2];
    const energy = this.energy;
    let [arriving, reflected] = [0, 0];
    for (let i = starts[shot]; i < starts[shot + 1]; i++) {
      const patch = first + patches[i];
      const [formFactor, material] = [weights[i] * unit, scene.material(patch)];
      arriving += formFactor;
      for (let colour = 0; colour < 3; colour++) {
        const leaving = power[colour] * formFactor * material[colour];
        reflected += leaving;
        this.radiosity[3 * patch + colour] += leaving / scene.areas[patch];
      }
    }
    const local = spans.kinds[span] === LOCAL;
    const all = arriving + (backs[shot] + escaped[shot] + outgoing[shot]) * unit;
    energy[local ? "unshot" : "transit"] -= sum * (local ? 1 : all);
    energy.unshot += reflected;
    energy.absorbed += sum * (arriving + backs[shot] * unit) - reflected;
    energy.escaped += sum * escaped[shot] * unit;
    energy.transit += sum * outgoing[shot] * unit;
    this.counts[local ? "local" : "received"]++;
  }
}

/** How a run's light and energy go through time, at `count` moments and the last. */
function course(run, count) {
  const light = new Light(run);
  light.goTo(Infinity);
  const last = light.radiosity.slice();
  light.restart();
  const scene = run.scene;
  const whole = difference(scene, last, null);
  const samples = [];
  for (let i = 0; i <= count; i++) {
    const time = (run.end * i) / count;
    const changed = light.goTo(time) || i === 0;
    const error = changed ? difference(scene, light.radiosity, last) / whole : samples[i - 1].error;
    samples.push({ time, error: Math.sqrt(error), ...light.energy });
  }
  return samples;
}

/** Sum over patches of area times squared difference of radiosity. */
function difference(scene, one, other) {
  let sum = 0;
  for (let patch = 0, i = 0; patch < scene.patches; patch++) {
    let squares = 0;
    for (let colour = 0; colour < 3; colour++, i++) {
      const apart = one[i] - (other ? other[i] : 0);
      squares += apart * apart;
    }
    sum += squares * scene.areas[patch];
  }
  return sum;
}
