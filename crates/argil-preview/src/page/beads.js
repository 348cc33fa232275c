// Beads as a mesh: cross-sections along the strand, joined to tubes.
//
// A bead is as wide and as high as its move says, with round sides. Cross-sections are mitred where the strand turns;
// where it turns back, the bead ends round and begins anew, as it does at the ends of the strand. Where role or width
// change there are two cross-sections, so that each side keeps its colour.

// Cosine of the turn beyond which a bead ends and begins anew: the mitre's tip would be far out.
const TURNS_BACK = -0.3;

// A round end: how far out each cross-section is, and how wide, in half widths.
const ROUND_END = [[0.5, 0.866], [0.866, 0.5], [1, 0.05]];

// A cross-section as pairs of the angle on the round side and which side: coarse ones for views of the whole print,
// fine ones from nearby. It runs from the lower left over the top to the lower right; the bottom joins its ends.
const COARSE = [[-0.25, -1], [0.45, -1], [0.45, 1], [-0.25, 1]];
const FINE = [[-0.5, -1], [-0.25, -1], [0, -1], [0.25, -1], [0.5, -1], [0.5, 1], [0.25, 1], [0, 1], [-0.25, 1], [-0.5, 1]];

class Stations {
  constructor(plan) {
    this.plan = plan;
    const room = plan.moves * 2 + 16;
    this.values = new Float32Array(room * 5); // x, y, z of the top, and the way across, in half widths
    this.owner = new Uint32Array(room); // the move whose colour and layer it has
    this.count = 0;
    this.links = new Uint32Array(room * 2); // pairs of stations
    this.linkCount = 0;
    this.firstLink = new Uint32Array(plan.moves + 2); // of each move
    this.along();
  }

  grow() {
    const double = (array) => {
      const larger = new array.constructor(array.length * 2);
      larger.set(array);
      return larger;
    };
    this.values = double(this.values);
    this.owner = double(this.owner);
    this.links = double(this.links);
  }

  add(move, x, y, z, across) {
    if ((this.count + 2) * 5 > this.values.length || this.linkCount * 2 + 4 > this.links.length) this.grow();
    this.values.set([x, y, z, across[0], across[1]], this.count * 5);
    this.owner[this.count] = move;
    return this.count++;
  }

  link(a, b) {
    this.links[2 * this.linkCount] = a;
    this.links[2 * this.linkCount + 1] = b;
    this.linkCount++;
  }

  // Directions of all moves; a move without length in the plane goes on as the one before.
  directions() {
    const { plan } = this;
    const directions = new Float32Array(2 * (plan.moves + 1));
    let last = [1, 0];
    for (let k = 1; k <= plan.moves; k++) {
      const dx = plan.x[k] - plan.x[k - 1], dy = plan.y[k] - plan.y[k - 1];
      const length = Math.hypot(dx, dy);
      if (length > 0) last = [dx / length, dy / length];
      directions[2 * k] = last[0];
      directions[2 * k + 1] = last[1];
    }
    return directions;
  }

  along() {
    const { plan } = this;
    const directions = this.directions();
    let begin = -1;
    for (let k = 1; k <= plan.moves; k++) {
      const [dx, dy] = [directions[2 * k], directions[2 * k + 1]];
      const left = [-dy, dx];
      this.firstLink[k] = this.linkCount;
      if (begin < 0) begin = this.end(k, k - 1, dx, dy, -1);
      if (k === plan.moves) {
        this.link(begin, this.end(k, k, dx, dy, 1));
        break;
      }
      const [ex, ey] = [directions[2 * k + 2], directions[2 * k + 3]];
      const cos = dx * ex + dy * ey;
      if (cos < TURNS_BACK) {
        this.link(begin, this.end(k, k, dx, dy, 1));
        begin = -1;
        continue;
      }
      // Half way between both directions, longer by the mitre.
      const share = 1 / (1 + cos);
      const across = [(left[0] - ey) * share, (left[1] + ex) * share];
      const station = this.add(k, plan.x[k], plan.y[k], plan.z[k], across);
      this.link(begin, station);
      const goesOn = plan.role[k] === plan.role[k + 1] && plan.wide[k] === plan.wide[k + 1];
      begin = goesOn ? station : this.add(k + 1, plan.x[k], plan.y[k], plan.z[k], across);
    }
    this.firstLink[plan.moves + 1] = this.linkCount;
  }

  // A round end of a move at a point: it grows from the tip at a beginning, and shrinks to it at an end.
  end(move, point, dx, dy, sense) {
    const { plan } = this;
    const half = plan.wide[move] / 2;
    const z = plan.z[point];
    const inner = this.add(move, plan.x[point], plan.y[point], z, [-dy, dx]);
    let last = inner;
    for (const [out, wide] of ROUND_END) {
      const [x, y] = [plan.x[point] + sense * out * half * dx, plan.y[point] + sense * out * half * dy];
      const station = this.add(move, x, y, z, [-dy * wide, dx * wide]);
      if (sense > 0) this.link(last, station); else this.link(station, last);
      last = station;
    }
    return inner;
  }
}

// Vertices of all stations with one cross-section, as a graphics card takes them.
class BeadMesh {
  constructor(stations, section) {
    const { plan } = stations;
    this.rows = section.length;
    this.stations = stations;
    const { low, high } = plan.box;
    const margin = plan.widest();
    // Places are integers on a grid over the box with room for mitres and ends.
    this.origin = low.map((v) => v - margin);
    this.grid = (Math.max(...low.map((v, k) => high[k] - v)) + 2 * margin) / 65535;
    this.places = new Uint16Array(4 * this.rows * stations.count);
    this.normals = new Int8Array(4 * this.rows * stations.count);
    for (let s = 0; s < stations.count; s++) this.station(s, section);
  }

  station(s, section) {
    const { plan, values, owner } = this.stations;
    const move = owner[s];
    const [width, height] = [plan.wide[move], plan.bead[move]];
    const round = Math.min(height, width) / 2;
    const flat = width / 2 - round;
    const [x, y, z, ax, ay] = values.subarray(5 * s, 5 * s + 5);
    section.forEach(([angle, side], row) => {
      const [sin, cos] = [Math.sin(angle * Math.PI), Math.cos(angle * Math.PI)];
      const out = -side * (flat + round * cos);
      const at = 4 * (this.rows * s + row);
      const place = [x + ax * out, y + ay * out, z - height / 2 + sin * height / 2];
      place.forEach((v, k) => { this.places[at + k] = Math.round((v - this.origin[k]) / this.grid); });
      const length = Math.hypot(ax, ay) || 1;
      this.normals[at] = -side * cos * ax / length * 127;
      this.normals[at + 1] = -side * cos * ay / length * 127;
      this.normals[at + 2] = sin * 127;
    });
  }

  tones(moveTones) {
    const { count, owner } = this.stations;
    const tones = new Uint8Array(this.rows * count);
    for (let s = 0; s < count; s++) tones.fill(moveTones[owner[s]], this.rows * s, this.rows * (s + 1));
    return tones;
  }

  // Triangles of the moves that are shown, the uppermost first: what is in front is then mostly drawn before what it
  // hides. The block of move k lies from offsets[k] to offsets[k - 1].
  triangles(shown, bottoms) {
    const { plan, firstLink, links } = this.stations;
    const offsets = new Uint32Array(plan.moves + 1);
    const sides = bottoms ? 1 : this.rows - 1;
    let total = 0;
    for (let k = plan.moves; k >= 1; k--) {
      offsets[k] = total;
      if (shown(k)) total += 6 * sides * (firstLink[k + 1] - firstLink[k]);
    }
    offsets[0] = total;
    const indices = new Uint32Array(total);
    let at = 0;
    for (let k = plan.moves; k >= 1; k--) {
      if (!shown(k)) continue;
      for (let l = firstLink[k]; l < firstLink[k + 1]; l++) {
        const a = links[2 * l] * this.rows, b = links[2 * l + 1] * this.rows;
        for (let side = 0; side < sides; side++) {
          const left = bottoms ? this.rows - 1 : side, right = bottoms ? 0 : side + 1;
          indices[at++] = a + right;
          indices[at++] = b + right;
          indices[at++] = b + left;
          indices[at++] = a + right;
          indices[at++] = b + left;
          indices[at++] = a + left;
        }
      }
    }
    return { indices, offsets };
  }
}
