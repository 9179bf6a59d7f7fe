// Vectors and matrices for the camera. Matrices are 4 × 4, in column-major order.

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const along = (a, s, b) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0],
];

function unit(a) {
  const length = Math.hypot(...a) || 1;
  return a.map((x) => x / length);
}

/** The unit vector of an angle around z and an angle above the horizon, radians. */
function direction(yaw, pitch) {
  return [Math.cos(pitch) * Math.cos(yaw), Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch)];
}

/** From world to clip coordinates: perspective from `eye` along `forward`; z is up. */
function project(eye, forward, fieldOfView, aspect, near, far) {
  const right = unit(cross(forward, [0, 0, 1]));
  const up = cross(right, forward);
  const y = 1 / Math.tan(fieldOfView / 2);
  const x = y / aspect;
  const [a, b] = [(far + near) / (far - near), (2 * far * near) / (far - near)];
  const rows = [
    [...right.map((v) => v * x), -dot(right, eye) * x],
    [...up.map((v) => v * y), -dot(up, eye) * y],
    [...forward.map((v) => v * a), -dot(forward, eye) * a - b],
    [...forward, -dot(forward, eye)],
  ];
  return Float32Array.from({ length: 16 }, (_, i) => rows[i % 4][i >> 2]);
}
