// Draws the scene with WebGL.

class Picture {
  constructor(canvas, scene) {
    this.canvas = canvas;
    this.scene = scene;
    const gl = (this.gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true }));
    if (!gl) throw new Error("this browser has no WebGL2");
    this.surface = shaders(gl, SURFACE_VERTEX, SURFACE_FRAGMENT);
    this.lines = shaders(gl, LINE_VERTEX, LINE_FRAGMENT);
    this.upload();
    this.boxes();
    Object.assign(this, { tone: 0, middle: 1, ceiling: Infinity, smooth: true });
  }

  /** A fan of triangles around the middle of each patch, as in the `radiosity` crate, and an empty table of colours. */
  upload() {
    const { gl, scene } = this;
    const { patches, positions, corners, cornerStarts } = scene;
    this.middles = positions.length / 3; // the texels of middles come after those of corners
    const count = corners.length + patches;
    const [points, patchOf, texelOf] = [new Float32Array(3 * count), new Uint32Array(count), new Uint32Array(count)];
    const triangles = [];
    this.firstTriangle = new Uint32Array(patches + 1);
    for (let patch = 0, vertex = 0; patch < patches; patch++) {
      const [from, to, middle] = [cornerStarts[patch], cornerStarts[patch + 1], vertex];
      points.set(this.alongEdges(patch, positions, 3), 3 * vertex);
      texelOf[vertex++] = this.middles + patch;
      for (let i = from; i < to; i++, vertex++) {
        points.set(positions.subarray(3 * corners[i], 3 * corners[i] + 3), 3 * vertex);
        texelOf[vertex] = corners[i];
        triangles.push(middle, vertex, i + 1 < to ? vertex + 1 : middle + 1);
      }
      patchOf.fill(patch, middle, vertex);
      this.firstTriangle[patch + 1] = triangles.length;
    }
    this.mesh = gl.createVertexArray();
    gl.bindVertexArray(this.mesh);
    this.attribute(0, points, 3);
    this.attribute(1, patchOf, 0);
    this.attribute(2, texelOf, 0);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, Uint32Array.from(triangles), gl.STATIC_DRAW);
    gl.bindVertexArray(null);
    this.rows = Math.ceil((this.middles + patches + 1) / WIDTH);
    this.colours = new Float32Array(4 * WIDTH * this.rows);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
      gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    }
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, WIDTH, this.rows, 0, gl.RGBA, gl.FLOAT, null);
  }

  /** The mean along the edges of a patch of three values per corner, which are `stride` apart in `values`. */
  alongEdges(patch, values, stride) {
    const { positions, corners, cornerStarts } = this.scene;
    const [from, to] = [cornerStarts[patch], cornerStarts[patch + 1]];
    const sum = [0, 0, 0];
    let length = 0;
    for (let i = from; i < to; i++) {
      const [a, b] = [corners[i], corners[i + 1 < to ? i + 1 : from]];
      const edge = Math.hypot(...[0, 1, 2].map((k) => positions[3 * a + k] - positions[3 * b + k]));
      for (let k = 0; k < 3; k++) sum[k] += ((values[stride * a + k] + values[stride * b + k]) / 2) * edge;
      length += edge;
    }
    return length > 0 ? sum.map((x) => x / length) : sum;
  }

  /** An attribute of corners: single-precision vectors, or integers if `size` is 0. */
  attribute(location, values, size) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(location);
    if (size) gl.vertexAttribPointer(location, size, gl.FLOAT, false, 0, 0);
    else gl.vertexAttribIPointer(location, 1, gl.UNSIGNED_INT, 0, 0);
  }

  /** The twelve edges of each environment's box. */
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

  /** Sets the colours from three numbers per patch. A smooth corner gets the mean of its patches, weighted by area. */
  paint(values) {
    const { scene: { patches, areas, corners, cornerStarts }, colours, gl, middles } = this;
    if (!this.smooth) {
      for (let patch = 0; patch < patches; patch++) {
        for (let colour = 0; colour < 3; colour++) colours[4 * patch + colour] = values[3 * patch + colour];
      }
    } else {
      colours.fill(0);
      for (let patch = 0; patch < patches; patch++) {
        const area = areas[patch];
        for (let i = cornerStarts[patch]; i < cornerStarts[patch + 1]; i++) {
          const texel = 4 * corners[i];
          for (let colour = 0; colour < 3; colour++) colours[texel + colour] += area * values[3 * patch + colour];
          colours[texel + 3] += area;
        }
      }
      for (let i = 0; i < 4 * middles; i += 4) {
        for (let colour = 0; colour < 3; colour++) colours[i + colour] /= colours[i + 3];
      }
      for (let patch = 0; patch < patches; patch++) colours.set(this.alongEdges(patch, colours, 4), 4 * (middles + patch));
    }
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, WIDTH, this.rows, gl.RGBA, gl.FLOAT, colours);
  }

  /** Draws some environments; `selected` ones get bright boxes. */
  draw(camera, environments, selected, showBoxes) {
    const { gl, canvas } = this;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0.112, 0.112, 0.112, 1);
    this.drawSurfaces(camera, environments, this.tone);
    const { program, uniforms } = this.lines;
    gl.useProgram(program);
    gl.uniformMatrix4fv(uniforms.camera, false, camera.matrix(canvas.width / canvas.height));
    gl.bindVertexArray(this.edges);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    if (showBoxes) {
      gl.uniform4f(uniforms.lineColour, 0.55, 0.75, 1, 0.32);
      gl.drawArrays(gl.LINES, 0, 24 * this.scene.environments);
    }
    gl.uniform4f(uniforms.lineColour, 1, 0.75, 0.2, 0.95);
    for (const environment of selected) gl.drawArrays(gl.LINES, 24 * environment, 24);
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

  /** The patch at a pixel, counted from the upper left, or -1. */
  patchAt(x, y, camera, environments) {
    const { gl, canvas } = this;
    gl.clearColor(0, 0, 0, 0);
    this.drawSurfaces(camera, environments, 4);
    const pixel = new Uint8Array(4);
    gl.readPixels(x, canvas.height - 1 - y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    return pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1;
  }
}
