// The camera of the 3D view: around a point, or on foot.

const FIELD_OF_VIEW = Math.PI / 5;

class Camera {
  constructor(scene) {
    this.scene = scene;
    this.reset();
  }

  /** Looks at the whole scene from above and the front. */
  reset() {
    const { low, high } = this.scene;
    this.look([low[0], low[1], low[2], high[0], high[1], high[2]], -1.9, -0.75);
  }

  /** Looks at a box, from where one sees all of it. */
  look(box, yaw = this.yaw, pitch = this.pitch) {
    const size = minus(box.slice(3, 6), box.slice(0, 3));
    this.target = [0, 1, 2].map((axis) => (box[axis] + box[axis + 3]) / 2);
    this.radius = Math.hypot(...size) / 2;
    this.distance = (this.radius / Math.sin(FIELD_OF_VIEW / 2)) * 0.86;
    [this.yaw, this.pitch, this.walking] = [yaw, pitch, false];
    this.yaw += Math.PI;
  }

  /** On foot, from the middle of what was looked at, at a person's height above its floor. */
  walk() {
    if (this.walking) return;
    const { low, high } = this.scene;
    this.walking = true;
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
    const sign = this.walking ? -1 : 1;
    this.yaw -= sign * yaw;
    this.pitch = Math.max(-1.55, Math.min(1.55, this.pitch - sign * pitch));
  }

  /** Steps forwards and to the right, in a walk; towards the target, around it. */
  step(forward, right, up = 0) {
    const size = this.walking ? 0.25 : this.distance * 0.05;
    const ahead = [Math.cos(this.yaw), Math.sin(this.yaw), 0];
    const aside = [ahead[1], -ahead[0], 0];
    const move = (point) =>
      along(along(along(point, forward * size, ahead), right * size, aside), up * size, [0, 0, 1]);
    if (this.walking) this.eye = move(this.eye);
    else this.target = move(this.target);
  }

  zoom(factor) {
    if (this.walking) this.step(factor < 1 ? 2 : -2, 0);
    else this.distance = Math.max(0.3, Math.min(this.distance * factor, 20 * this.radius));
  }

  matrix(aspect) {
    const { low, high } = this.scene;
    const extent = Math.hypot(...minus(high, low));
    const away = Math.hypot(...minus(this.position, [0, 1, 2].map((i) => (low[i] + high[i]) / 2)));
    const wide = aspect < 1 ? 2 * Math.atan(Math.tan(FIELD_OF_VIEW / 2) / aspect) : FIELD_OF_VIEW;
    const field = this.walking ? 1.2 : wide;
    const near = this.walking ? 0.03 : Math.max(0.03, away - extent);
    return project(this.position, this.forward, field, aspect, near, away + extent);
  }
}
