// Beads in space by WebGL 2.

const VERTEX = `#version 300 es
  uniform mat4 view;
  uniform vec4 grid;           // origin of the places and their step
  uniform vec3 light;          // towards the light, of length 1
  uniform sampler2D table;     // the colour of each tone
  layout(location = 0) in vec4 place;
  layout(location = 1) in vec4 normal;
  layout(location = 2) in uint tone;
  out vec3 colour;
  void main() {
    gl_Position = view * vec4(grid.xyz + grid.w * place.xyz, 1.0);
    float lit = dot(normalize(normal.xyz), light);
    float shade = lit > 0.0 ? 0.52 + 0.5 * lit : 0.52 + 0.3 * lit;
    colour = texelFetch(table, ivec2(int(tone), 0), 0).rgb * shade;
  }`;
const FRAGMENT = `#version 300 es
  precision mediump float;
  in vec3 colour;
  out vec4 shown;
  void main() { shown = vec4(colour, 1.0); }`;

// Moves that are drawn or left out together when part of the print is outside of the picture.
const CHUNK = 512;

// Height of a layer on the screen, pixels, from which on beads are drawn finely; and moves up to which they can be.
const NEAR = 12;
const MOST_FINE = 200000;

class SolidView {
  // Null where the browser has no WebGL 2, or has it only by software (unless that will do), which is far slower than
  // drawing without.
  static on(canvas, plan, softwareWillDo) {
    const gl = canvas.getContext("webgl2", {
      antialias: true,
      powerPreference: "high-performance",
      failIfMajorPerformanceCaveat: !softwareWillDo,
    });
    return gl && (softwareWillDo || !bySoftware(gl)) ? new SolidView(canvas, gl, plan) : null;
  }

  constructor(canvas, gl, plan) {
    this.name = "WebGL 2";
    this.canvas = canvas;
    this.gl = gl;
    this.plan = plan;
    this.stations = new Stations(plan);
    this.chunks = this.boxes();
    this.start();
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => { this.start(); this.restored?.(); });
  }

  // Everything that lives on the graphics card; anew when the card has lost it.
  start() {
    const gl = this.gl;
    this.program = this.link(VERTEX, FRAGMENT);
    this.uniforms = {};
    for (const name of ["view", "grid", "light", "table"]) {
      this.uniforms[name] = gl.getUniformLocation(this.program, name);
    }
    this.table = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.table);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    this.meshes = {};
    this.coloured = this.shown = null;
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.CULL_FACE);
  }

  link(...sources) {
    const gl = this.gl;
    const program = gl.createProgram();
    sources.forEach((source, k) => {
      const shader = gl.createShader(k === 0 ? gl.VERTEX_SHADER : gl.FRAGMENT_SHADER);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    });
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
      throw new Error(`the shaders do not link: ${gl.getProgramInfoLog(program)}`);
    }
    return program;
  }

  // Balls round every chunk of moves.
  boxes() {
    const { plan } = this;
    const chunks = [];
    for (let first = 1; first <= plan.moves; first += CHUNK) {
      const last = Math.min(plan.moves, first + CHUNK - 1);
      const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
      for (let k = first - 1; k <= last; k++) {
        [plan.x[k], plan.y[k], plan.z[k]].forEach((v, axis) => {
          low[axis] = Math.min(low[axis], v);
          high[axis] = Math.max(high[axis], v);
        });
      }
      const { width, height } = plan.layers[plan.layerOf[last]];
      const radius = Math.hypot(...low.map((v, k) => high[k] - v)) / 2 + width + height;
      chunks.push({ first, last, middle: low.map((v, k) => (v + high[k]) / 2), radius });
    }
    return chunks;
  }

  mesh(fine) {
    const name = fine ? "fine" : "coarse";
    if (!this.meshes[name]) {
      const gl = this.gl;
      const beads = new BeadMesh(this.stations, fine ? FINE : COARSE);
      const array = gl.createVertexArray();
      gl.bindVertexArray(array);
      const attribute = (data, location, connect) => {
        const buffer = gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
        gl.enableVertexAttribArray(location);
        connect();
        return buffer;
      };
      attribute(beads.places, 0, () => gl.vertexAttribPointer(0, 4, gl.UNSIGNED_SHORT, false, 8, 0));
      attribute(beads.normals, 1, () => gl.vertexAttribPointer(1, 4, gl.BYTE, true, 4, 0));
      const tones = attribute(new Uint8Array(beads.rows * this.stations.count), 2,
        () => gl.vertexAttribIPointer(2, 1, gl.UNSIGNED_BYTE, 1, 0));
      const { origin, grid } = beads;
      this.meshes[name] = { beads: { ...beads, places: null, normals: null }, array, tones, frame: [...origin, grid] };
      Object.setPrototypeOf(this.meshes[name].beads, BeadMesh.prototype);
    }
    return this.meshes[name];
  }

  // Tones of all moves and the colours of the tones.
  colour(tones, table) {
    const gl = this.gl;
    this.coloured = { tones };
    gl.bindTexture(gl.TEXTURE_2D, this.table);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    const texels = new Uint8Array(table.flat());
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, table.length, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, texels);
  }

  // Which moves are shown at all, as a function of the move.
  show(shown) {
    this.shown = { test: shown };
  }

  // A mesh with the tones and triangles of now.
  ready(fine, below) {
    const gl = this.gl;
    const mesh = this.mesh(fine);
    gl.bindVertexArray(mesh.array);
    if (mesh.coloured !== this.coloured) {
      gl.bindBuffer(gl.ARRAY_BUFFER, mesh.tones);
      gl.bufferData(gl.ARRAY_BUFFER, mesh.beads.tones(this.coloured.tones), gl.STATIC_DRAW);
      mesh.coloured = this.coloured;
    }
    if (mesh.shown !== this.shown) {
      for (const faces of mesh.faces ?? []) gl.deleteBuffer(faces?.buffer);
      mesh.faces = [null, null];
      mesh.shown = this.shown;
    }
    for (const bottoms of below ? [0, 1] : [0]) {
      if (mesh.faces[bottoms]) continue;
      const { indices, offsets } = mesh.beads.triangles(this.shown.test, bottoms === 1);
      const buffer = gl.createBuffer();
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
      mesh.faces[bottoms] = { buffer, offsets };
    }
    return mesh;
  }

  // Draws the moves from `first` to `last`, in pixels of which there are `density` to a pixel of the screen.
  draw(camera, first, last, { density, background }) {
    const gl = this.gl;
    const [width, height] = [camera.width * density, camera.height * density].map(Math.round);
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    gl.viewport(0, 0, width, height);
    gl.clearColor(...background.map((v) => v / 255), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const ranges = this.inSight(camera, first, last);
    const layer = this.plan.layers[this.plan.layerAt(last)];
    let visible = 0;
    for (const range of ranges) visible += range[1] - range[0] + 1;
    const fine = layer.height * camera.scale > NEAR && visible <= MOST_FINE && this.plan.moves <= 2 * MOST_FINE;
    const below = camera.elevation < 0;
    const mesh = this.ready(fine, below);
    gl.useProgram(this.program);
    gl.uniformMatrix4fv(this.uniforms.view, false, camera.matrix());
    gl.uniform4fv(this.uniforms.grid, mesh.frame);
    gl.uniform3fv(this.uniforms.light, lightFrom(camera.axes()));
    gl.uniform1i(this.uniforms.table, 0);
    for (const { buffer, offsets } of mesh.faces.filter((faces, k) => faces && (k === 0 || below))) {
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
      for (const [a, b] of ranges) {
        const count = offsets[a - 1] - offsets[b];
        if (count > 0) gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 4 * offsets[b]);
      }
    }
    return visible;
  }

  // The runs of moves whose chunks reach into the picture, the uppermost first.
  inSight(camera, first, last) {
    const ranges = [];
    const half = [camera.width / camera.scale / 2, camera.height / camera.scale / 2];
    const reaches = (chunk) => {
      const [x, y] = camera.relative(chunk.middle);
      return Math.abs(x) <= half[0] + chunk.radius && Math.abs(y) <= half[1] + chunk.radius;
    };
    for (let c = this.chunks.length - 1; c >= 0; c--) {
      const chunk = this.chunks[c];
      if (chunk.last < first || chunk.first > last || !reaches(chunk)) continue;
      const [a, b] = [Math.max(first, chunk.first), Math.min(last, chunk.last)];
      const before = ranges[ranges.length - 1];
      if (before && before[0] === b + 1) before[0] = a; else ranges.push([a, b]);
    }
    return ranges;
  }
}

// Whether the name of what draws is that of a program: not every browser owns to it when asked for the caveat.
function bySoftware(gl) {
  const named = gl.getExtension("WEBGL_debug_renderer_info");
  const renderer = gl.getParameter(named ? named.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(renderer);
}
