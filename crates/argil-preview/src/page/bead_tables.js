// What a bead looks like from the eye, pixel by pixel, for drawing without a graphics card.
//
// A parallel view shows a bead of one size and direction everywhere alike. So it is worked out once for each direction:
// how near to the eye and how light the bead is at each pixel across it, and how far ahead of the middle that part of
// its surface lies, which tells where the bead ends. A move is then drawn by repeating that stripe along its line. The
// axis along which it is repeated is the one, x or y of the screen, along which the move is longer.
// Where strands end or turn sharply, and where they run towards the eye, a round disc of paste is drawn in its place.

// Directions that are told apart, in half a turn: steps of 1.4 degrees.
const DIRECTIONS = 128;

// Steps of light.
const SHADES = 32;

// Points on the bead's outline.
const OUTLINE = 40;

// Moves that look shorter than this share of their length run towards the eye.
const TOWARDS = 0.2;

const ALONG_X = 0, ALONG_Y = 1, AS_DISCS = 2;

function shadeOf(lit) {
  return Math.round((lit + 1) * 0.5 * (SHADES - 1));
}

// The light that a shade stands for, as a share of the full colour.
function lightOf(shade) {
  const lit = 2 * shade / (SHADES - 1) - 1;
  return lit > 0 ? 0.52 + 0.5 * lit : 0.52 + 0.3 * lit;
}

class BeadTables {
  // Axes and light are unit vectors; the scale is in pixels to the millimetre.
  constructor(width, height, scale, axes, light) {
    Object.assign(this, { width, height, scale, light });
    this.toScreen = (p) => [
      scale * (axes.right[0] * p[0] + axes.right[1] * p[1] + axes.right[2] * p[2]),
      -scale * (axes.up[0] * p[0] + axes.up[1] * p[1] + axes.up[2] * p[2]),
      scale * (axes.eye[0] * p[0] + axes.eye[1] * p[1] + axes.eye[2] * p[2]),
    ];
    this.axes = axes;
    this.round = Math.min(width, height) / 2;
    this.flat = width / 2 - this.round;
    // Pixels across a bead at most, and so the room that each stripe has.
    this.room = 2 * Math.ceil(scale * Math.hypot(width, height) * 0.75 / TOWARDS ** 0.5) + 4;
    this.kind = new Uint8Array(DIRECTIONS);
    this.low = new Int32Array(DIRECTIONS);
    this.count = new Int32Array(DIRECTIONS);
    this.reach = new Float32Array(DIRECTIONS);
    this.depth = new Float32Array(DIRECTIONS * this.room);
    this.ahead = new Float32Array(DIRECTIONS * this.room);
    this.shade = new Uint8Array(DIRECTIONS * this.room);
    for (let k = 0; k < DIRECTIONS; k++) this.stripe(k);
    this.disc = this.discOf();
  }

  // The outline's points and normals, across the bead and upwards.
  outline() {
    const points = [];
    for (let k = 0; k <= OUTLINE; k++) {
      const angle = 2 * Math.PI * k / OUTLINE;
      const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
      const side = Math.abs(cos) < 1e-9 ? 0 : Math.sign(cos);
      points.push([side * this.flat + cos * this.round, sin * this.height / 2, cos, sin]);
    }
    return points;
  }

  stripe(k) {
    const angle = Math.PI * (k + 0.5) / DIRECTIONS;
    const [dx, dy] = [Math.cos(angle), Math.sin(angle)];
    const along = this.toScreen([dx, dy, 0]);
    const shown = Math.hypot(along[0], along[1]) / this.scale;
    if (shown < TOWARDS) {
      this.kind[k] = AS_DISCS;
      return;
    }
    const major = Math.abs(along[0]) >= Math.abs(along[1]) ? 0 : 1;
    this.kind[k] = major === 0 ? ALONG_X : ALONG_Y;
    // Each point of the outline, brought along the bead to where the major axis is 0.
    const placed = this.outline().map(([across, up, cos, sin]) => {
      const q = this.toScreen([-dy * across, dx * across, up]);
      const back = -q[major] / along[major];
      const normal = [-dy * cos, dx * cos, sin];
      const lit = normal[0] * this.light[0] + normal[1] * this.light[1] + normal[2] * this.light[2];
      return [q[1 - major] + back * along[1 - major], q[2] + back * along[2], lit, q[major]];
    });
    this.reach[k] = Math.max(...placed.map((point) => Math.abs(point[3])));
    const offsets = placed.map((point) => point[0]);
    const low = Math.ceil(Math.min(...offsets) - 0.5), high = Math.floor(Math.max(...offsets) + 0.5);
    const count = Math.min(this.room, high - low + 1);
    this.low[k] = low;
    this.count[k] = count;
    const start = k * this.room;
    this.depth.fill(-Infinity, start, start + count);
    for (let j = 0; j < OUTLINE; j++) this.edge(placed[j], placed[j + 1], start, low, count);
    // The outermost pixels may have no more than a part of the bead in them.
    for (const [end, inner] of [[0, 1], [count - 1, count - 2]]) {
      if (this.depth[start + end] === -Infinity && count > 1) {
        this.depth[start + end] = this.depth[start + inner];
        this.shade[start + end] = this.shade[start + inner];
        this.ahead[start + end] = this.ahead[start + inner];
      }
    }
  }

  // The part of a stripe between two neighbours on the outline, where it is nearer than what is there.
  edge(a, b, start, low, count) {
    if (a[0] > b[0]) [a, b] = [b, a];
    const from = Math.max(0, Math.ceil(a[0] - low)), to = Math.min(count - 1, Math.floor(b[0] - low));
    for (let j = from; j <= to; j++) {
      const share = b[0] > a[0] ? (j + low - a[0]) / (b[0] - a[0]) : 0;
      const depth = a[1] + (b[1] - a[1]) * share;
      if (depth > this.depth[start + j]) {
        this.depth[start + j] = depth;
        this.shade[start + j] = shadeOf(a[2] + (b[2] - a[2]) * share);
        this.ahead[start + j] = a[3] + (b[3] - a[3]) * share;
      }
    }
  }

  // A disc as wide as the bead with a round rim: distances from it are known, so that rays find it step by step.
  discOf() {
    const { right, up, eye } = this.axes;
    const half = Math.ceil(this.scale * (this.width / 2)) + 1;
    const size = 2 * half + 1;
    const depth = new Float32Array(size * size).fill(-Infinity);
    const shade = new Uint8Array(size * size);
    const reach = Math.hypot(this.width, this.height) / 2;
    const stretch = this.height / (2 * this.round);
    for (let v = -half; v <= half; v++) {
      for (let u = -half; u <= half; u++) {
        let t = reach;
        let at = null;
        for (let step = 0; step < 40 && t > -reach; step++) {
          at = [0, 1, 2].map((k) => (right[k] * u - up[k] * v) / this.scale + eye[k] * t);
          const out = Math.hypot(at[0], at[1]);
          const near = Math.hypot(Math.max(0, out - this.flat), at[2] / stretch) - this.round;
          if (near < 0.02 * this.round) {
            const rim = Math.max(0, out - this.flat) / (out || 1);
            const normal = [at[0] * rim, at[1] * rim, at[2] / stretch];
            const length = Math.hypot(...normal) || 1;
            const lit = normal.reduce((sum, n, k) => sum + n * this.light[k], 0) / length;
            depth[(v + half) * size + u + half] = t * this.scale;
            shade[(v + half) * size + u + half] = shadeOf(lit);
            break;
          }
          t -= near * Math.min(1, stretch);
        }
      }
    }
    // Where each row begins and ends.
    const begins = new Int32Array(size), ends = new Int32Array(size);
    for (let v = 0; v < size; v++) {
      const row = depth.subarray(v * size, (v + 1) * size);
      begins[v] = row.findIndex((d) => d > -Infinity);
      ends[v] = begins[v] < 0 ? begins[v] : row.findLastIndex((d) => d > -Infinity) + 1;
    }
    return { half, size, depth, shade, begins, ends };
  }
}
