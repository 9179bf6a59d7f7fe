// Shaders: look up the radiosity of a corner, and map it to a colour.

const WIDTH = 1024; // texels per row of the table of radiosities

const SURFACE_VERTEX = `#version 300 es
layout(location = 0) in vec3 point;
layout(location = 1) in uint patch_;
layout(location = 2) in uint corner;
uniform mat4 camera;
uniform bool smooth_;
uniform sampler2D table;
out vec3 radiosity;
out vec3 place;
flat out uint number;
void main() {
  int texel = int(smooth_ ? corner : patch_);
  radiosity = texelFetch(table, ivec2(texel % ${WIDTH}, texel / ${WIDTH}), 0).rgb;
  place = point;
  number = patch_;
  gl_Position = camera * vec4(point, 1.0);
}`;

// Reinhard et al. 2002, equation 4, on the luminance, as in the `radiosity` crate.
const SURFACE_FRAGMENT = `#version 300 es
precision highp float;
in vec3 radiosity;
in vec3 place;
flat in uint number;
uniform int tone; // 0 Reinhard, 1 linear, 2 false colour, 3 plain colour with shading, 4 number of the patch
uniform float middle; // the radiosity that becomes middle grey
uniform float ceiling_;
out vec4 colour;
const vec3 EYE = vec3(0.2126, 0.7152, 0.0722);
vec3 srgb(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
vec3 heat(float x) { // black, blue, magenta, orange, white
  return clamp(vec3(2.4 * x - 0.35, 2.2 * x - 1.1 + 0.6 * max(0.0, 0.25 - x),
    x < 0.4 ? 2.2 * x : max(0.88 - 3.0 * (x - 0.4), 4.0 * x - 3.0)), 0.0, 1.0);
}
void main() {
  if (place.z > ceiling_) discard;
  if (tone == 4) {
    uint n = number + 1u;
    colour = vec4(float(n & 255u), float((n >> 8) & 255u), float(n >> 16), 255.0) / 255.0;
  } else if (tone == 3) {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    colour = vec4(radiosity * (0.72 + 0.28 * abs(dot(normal, normalize(vec3(0.45, -0.25, 0.8))))), 1.0);
  } else {
    vec3 relative = radiosity / middle;
    if (tone == 2) {
      float stops = log2(max(dot(relative, EYE), 1e-9));
      colour = vec4(heat((stops + 5.0) / 9.0), 1.0);
    } else {
      float light = dot(relative, EYE) * 0.35;
      float reinhard = 0.35 * (1.0 + light / (2.1 * 2.1)) / (1.0 + light);
      colour = vec4(srgb(relative * (tone == 0 ? reinhard : 0.18)), 1.0);
    }
  }
}`;

const LINE_VERTEX = `#version 300 es
layout(location = 0) in vec3 point;
uniform mat4 camera;
void main() { gl_Position = camera * vec4(point, 1.0); }`;

const LINE_FRAGMENT = `#version 300 es
precision mediump float;
uniform vec4 lineColour;
out vec4 colour;
void main() { colour = lineColour; }`;

/** Compiles and links a program; returns it with its uniforms by name. */
function shaders(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  const uniforms = {};
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
    const { name } = gl.getActiveUniform(program, i);
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return { program, uniforms };
}
