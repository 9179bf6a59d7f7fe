// The camera of the 3D view: orbits a point, or walks.

const FIELD_OF_VIEW = Math.PI / 6; // as in the `radiosity` crate

class Camera {
  constructor(scene) {
    this.scene = scene;
    this.reset();
  }

  /** Looks at the whole scene from above and the front. */
  reset() {
    this.look([...this.scene.low, ...this.scene.high]);
  }

  /** Looks at a box from above and the front. The distance is set when the picture's aspect ratio is known. */
  look(box) {
    const size = minus(box.slice(3, 6), box.slice(0, 3));
    Object.assign(this, { box, radius: Math.hypot(...size) / 2, walking: false, fitted: false });
    [this.yaw, this.pitch] = [Math.atan2(0.9, -0.25), -Math.atan2(1.1, Math.hypot(0.25, 0.9))];
    this.fit(1.6);
  }

  /** The least distance from which the box fits into the picture, as in the `radiosity` crate. */
  fit(aspect) {
    const [low, high] = [this.box.slice(0, 3), this.box.slice(3, 6)];
    const centre = low.map((x, axis) => (x + high[axis]) / 2);
    const corners = Array.from({ length: 8 }, (_, i) => centre.map((c, axis) => ((i >> axis) & 1 ? high[axis] - c : low[axis] - c)));
    const { forward } = this;
    const right = unit(cross(forward, [0, 0, 1]));
    const side = (axis, slope) => {
      const most = Math.max(...corners.map((c) => dot(c, axis) - slope * dot(c, forward)));
      const least = Math.min(...corners.map((c) => dot(c, axis) + slope * dot(c, forward)));
      return { distance: (most - least) / (2 * slope), shift: (most + least) / 2 };
    };
    const slope = Math.tan(FIELD_OF_VIEW / 2) * 0.96;
    const across = side(right, slope * aspect);
    const upward = side(cross(right, forward), slope);
    this.distance = Math.max(across.distance, upward.distance);
    this.target = along(along(centre, across.shift, right), upward.shift, cross(right, forward));
  }

  /** Walks, from the middle of what was seen, at eye level above the floor. */
  walk() {
    if (this.walking) return;
    const { low, high } = this.scene;
    Object.assign(this, { walking: true, fitted: true });
    this.eye = [this.target[0], this.target[1], Math.min(low[2] + 1.7, (low[2] + high[2]) / 2)];
    this.pitch = 0;
  }

  orbit() {
    this.walking = false;
    this.pitch = -0.75;
  }

  get forward() {
    return direction(this.yaw, this.pitch);
  }

  get position() {
    return this.walking ? this.eye : along(this.target, -this.distance, this.forward);
  }

  turn(yaw, pitch) {
    this.fitted = true;
    const sign = this.walking ? -1 : 1;
    this.yaw -= sign * yaw;
    this.pitch = Math.max(-1.55, Math.min(1.55, this.pitch - sign * pitch));
  }

  /** Moves forwards, to the right and up: the eye in a walk, else the target. */
  step(forward, right, up = 0) {
    this.fitted = true;
    const size = this.walking ? 0.25 : this.distance * 0.05;
    const ahead = [Math.cos(this.yaw), Math.sin(this.yaw), 0];
    const aside = [ahead[1], -ahead[0], 0];
    const move = (point) =>
      along(along(along(point, forward * size, ahead), right * size, aside), up * size, [0, 0, 1]);
    if (this.walking) this.eye = move(this.eye);
    else this.target = move(this.target);
  }

  zoom(factor) {
    this.fitted = true;
    if (this.walking) this.step(factor < 1 ? 2 : -2, 0);
    else this.distance = Math.max(0.3, Math.min(this.distance * factor, 20 * this.radius));
  }

  matrix(aspect) {
    if (!this.fitted) this.fit(aspect);
    const { low, high } = this.scene;
    const extent = Math.hypot(...minus(high, low));
    const away = Math.hypot(...minus(this.position, [0, 1, 2].map((i) => (low[i] + high[i]) / 2)));
    const field = this.walking ? 1.2 : FIELD_OF_VIEW;
    const near = this.walking ? 0.03 : Math.max(0.03, away - extent);
    return project(this.position, this.forward, field, aspect, near, away + extent);
  }
}
