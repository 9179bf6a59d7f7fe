// The scene on the graphics processor.

class Picture {
  constructor(canvas, scene) {
    this.canvas = canvas;
    this.scene = scene;
    const gl = (this.gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true }));
    if (!gl) throw new Error("this browser shows no WebGL2");
    this.surface = shaders(gl, SURFACE_VERTEX, SURFACE_FRAGMENT);
    this.lines = shaders(gl, LINE_VERTEX, LINE_FRAGMENT);
    this.weld();
    this.upload();
    this.boxes();
    Object.assign(this, { tone: 0, middle: 1, ceiling: Infinity, smooth: true });
  }

  /** Corners of patches of one polygon that lie in one place count as one: what smooth shading needs. */
  weld() {
    const { scene } = this;
    const known = new Map();
    this.cornerOf = new Uint32Array(scene.corners.length / 3);
    for (let patch = 0; patch < scene.patches; patch++) {
      for (let i = scene.cornerStarts[patch]; i < scene.cornerStarts[patch + 1]; i++) {
        const [x, y, z] = scene.corners.subarray(3 * i, 3 * i + 3);
        const key = `${scene.polygons[patch]},${x},${y},${z}`;
        if (!known.has(key)) known.set(key, known.size);
        this.cornerOf[i] = known.get(key);
      }
    }
    this.places = known.size;
  }

  /** Geometry, and an empty table of colours. */
  upload() {
    const { gl, scene } = this;
    const count = scene.corners.length / 3;
    const patchOf = new Uint32Array(count);
    const triangles = [];
    this.firstTriangle = new Uint32Array(scene.patches + 1);
    for (let patch = 0; patch < scene.patches; patch++) {
      const [from, to] = [scene.cornerStarts[patch], scene.cornerStarts[patch + 1]];
      patchOf.fill(patch, from, to);
      for (let i = from + 2; i < to; i++) triangles.push(from, i - 1, i);
      this.firstTriangle[patch + 1] = triangles.length;
    }
    this.mesh = gl.createVertexArray();
    gl.bindVertexArray(this.mesh);
    this.attribute(0, scene.corners, 3);
    this.attribute(1, patchOf, 0);
    this.attribute(2, this.cornerOf, 0);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, Uint32Array.from(triangles), gl.STATIC_DRAW);
    gl.bindVertexArray(null);
    this.rows = Math.ceil(Math.max(this.places, scene.patches, 1) / WIDTH);
    this.colours = new Float32Array(4 * WIDTH * this.rows);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
      gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    }
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, WIDTH, this.rows, 0, gl.RGBA, gl.FLOAT, null);
  }

  /** An attribute of corners: single-precision vectors, or whole numbers where `size` is 0. */
  attribute(place, values, size) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(place);
    if (size) gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
    else gl.vertexAttribIPointer(place, 1, gl.UNSIGNED_INT, 0, 0);
  }

  /** Twelve edges of each environment's box. */
  boxes() {
    const points = [];
    for (const box of this.scene.boxes) {
      for (let axis = 0; axis < 3; axis++) {
        for (let side = 0; side < 4; side++) {
          const end = (upper) => {
            const corner = [0, 0, 0];
            corner[axis] = box[axis + 3 * upper];
            corner[(axis + 1) % 3] = box[((axis + 1) % 3) + 3 * (side & 1)];
            corner[(axis + 2) % 3] = box[((axis + 2) % 3) + 3 * (side >> 1)];
            return corner;
          };
          points.push(...end(0), ...end(1));
        }
      }
    }
    this.edges = this.gl.createVertexArray();
    this.gl.bindVertexArray(this.edges);
    this.attribute(0, Float32Array.from(points), 3);
    this.gl.bindVertexArray(null);
  }

  /** Takes colours, three numbers a patch; smooth ones are means of the patches around a corner. */
  paint(values) {
    const { scene, colours, cornerOf, gl } = this;
    if (!this.smooth) {
      for (let patch = 0; patch < scene.patches; patch++) {
        for (let colour = 0; colour < 3; colour++) colours[4 * patch + colour] = values[3 * patch + colour];
      }
    } else {
      colours.fill(0);
      for (let patch = 0; patch < scene.patches; patch++) {
        for (let i = scene.cornerStarts[patch]; i < scene.cornerStarts[patch + 1]; i++) {
          const place = 4 * cornerOf[i];
          for (let colour = 0; colour < 3; colour++) colours[place + colour] += values[3 * patch + colour];
          colours[place + 3]++;
        }
      }
      for (let i = 0; i < 4 * this.places; i += 4) {
        for (let colour = 0; colour < 3; colour++) colours[i + colour] /= colours[i + 3];
      }
    }
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, WIDTH, this.rows, gl.RGBA, gl.FLOAT, colours);
  }

  /** Draws what `camera` sees of some environments; `chosen` ones get bright boxes. */
  draw(camera, environments, chosen, showBoxes) {
    const { gl, canvas } = this;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0.07, 0.075, 0.085, 1);
    this.drawSurfaces(camera, environments, this.tone);
    const { program, uniforms } = this.lines;
    gl.useProgram(program);
    gl.uniformMatrix4fv(uniforms.camera, false, camera.matrix(canvas.width / canvas.height));
    gl.bindVertexArray(this.edges);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    if (showBoxes) {
      gl.uniform4f(uniforms.ink, 0.55, 0.75, 1, 0.32);
      gl.drawArrays(gl.LINES, 0, 24 * this.scene.environments);
    }
    gl.uniform4f(uniforms.ink, 1, 0.75, 0.2, 0.95);
    for (const environment of chosen) gl.drawArrays(gl.LINES, 24 * environment, 24);
    gl.disable(gl.BLEND);
    gl.bindVertexArray(null);
  }

  drawSurfaces(camera, environments, tone) {
    const { gl, canvas, scene } = this;
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.CULL_FACE);
    const { program, uniforms } = this.surface;
    gl.useProgram(program);
    gl.uniformMatrix4fv(uniforms.camera, false, camera.matrix(canvas.width / canvas.height));
    gl.uniform1i(uniforms.smooth_, this.smooth ? 1 : 0);
    gl.uniform1i(uniforms.tone, tone);
    gl.uniform1f(uniforms.middle, this.middle);
    gl.uniform1f(uniforms.ceiling_, this.ceiling);
    gl.bindVertexArray(this.mesh);
    for (const environment of environments) {
      const from = this.firstTriangle[scene.patchStarts[environment]];
      const to = this.firstTriangle[scene.patchStarts[environment + 1]];
      if (to > from) gl.drawElements(gl.TRIANGLES, to - from, gl.UNSIGNED_INT, 4 * from);
    }
    gl.bindVertexArray(null);
  }

  /** The patch that is seen at a pixel, counted from the upper left; -1 where there is none. */
  patchAt(x, y, camera, environments) {
    const { gl, canvas } = this;
    gl.clearColor(0, 0, 0, 0);
    this.drawSurfaces(camera, environments, 4);
    const pixel = new Uint8Array(4);
    gl.readPixels(x, canvas.height - 1 - y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    return pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1;
  }
}
