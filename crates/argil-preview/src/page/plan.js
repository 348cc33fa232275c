// The strand as the page carries it: points on a grid, a role for each move, layers from the lowest up.
//
// Moves are counted from 1: move k leads from point k - 1 to point k. Where something is shown up to a place on the
// strand, the place is such a number, with a fraction inside of a move.

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; k++) bytes[k] = text.charCodeAt(k);
  return bytes;
}

class Plan {
  constructor(data) {
    this.title = data.title;
    this.facts = data.facts;
    this.roles = data.roles.map(([name, colour]) => ({ name, colour }));
    this.kinds = data.kinds.map(([name, fault, unit]) => ({ name, fault, unit, marks: [] }));
    this.wholeMoves = data.moves;
    this.off = data.off;

    const grid = new DataView(bytesOf(data.points).buffer);
    const count = grid.byteLength / 4;
    this.moves = count - 1;
    this.x = new Float32Array(count);
    this.y = new Float32Array(count);
    this.z = new Float32Array(count);
    this.bead = new Float32Array(count); // the height of the bead of each move
    this.wide = new Float32Array(count); // and its width
    for (let k = 0; k < count; k++) {
      this.x[k] = data.origin[0] + data.step * grid.getUint16(4 * k, true);
      this.y[k] = data.origin[1] + data.step * grid.getUint16(4 * k + 2, true);
    }
    const roles = bytesOf(data.moveRoles);
    this.role = new Uint8Array(count);
    this.role.set(roles, 1);

    // For each layer its first and last move, and for each move its layer, length so far and time so far.
    this.layerOf = new Uint32Array(count);
    this.layers = [];
    let last = 0;
    for (const [index, z, height, width, points, speed] of data.layers) {
      const layer = { index, z, height, width, speed, first: last + 1, last: last + points };
      this.layerOf.fill(this.layers.length, layer.first, layer.last + 1);
      this.z.fill(z, layer.first, layer.last + 1);
      this.bead.fill(height, layer.first, layer.last + 1);
      this.wide.fill(width, layer.first, layer.last + 1);
      this.layers.push(layer);
      last = layer.last;
    }
    this.z[0] = this.layers[0].z;
    if (data.rises) {
      const rises = new DataView(bytesOf(data.rises).buffer);
      for (let k = 0; k < count; k++) {
        this.z[k] = data.climb * rises.getUint16(4 * k, true);
        this.bead[k] = data.climb * rises.getUint16(4 * k + 2, true);
      }
    }
    if (data.widths) {
      bytesOf(data.widths).forEach((share, k) => { this.wide[k + 1] *= share / data.shares; });
    }
    this.length = new Float64Array(count);
    this.time = new Float64Array(count);
    for (let k = 1; k < count; k++) {
      const step = Math.hypot(this.x[k] - this.x[k - 1], this.y[k] - this.y[k - 1], this.z[k] - this.z[k - 1]);
      this.length[k] = this.length[k - 1] + step;
      this.time[k] = this.time[k - 1] + step / this.layers[this.layerOf[k]].speed;
    }

    data.marks.forEach(([kind, layer, x, y, measure, last], number) => {
      this.kinds[kind].marks.push({ number, kind, layer, last, x, y, measure });
    });
    this.box = this.frame();
  }

  // The box round all beads.
  frame() {
    const low = [Infinity, Infinity, 0], high = [-Infinity, -Infinity, 0];
    const half = this.widest() / 2;
    for (let k = 0; k <= this.moves; k++) {
      low[0] = Math.min(low[0], this.x[k] - half);
      low[1] = Math.min(low[1], this.y[k] - half);
      high[0] = Math.max(high[0], this.x[k] + half);
      high[1] = Math.max(high[1], this.y[k] + half);
    }
    low[2] = Math.min(0, this.layers[0].z - this.layers[0].height);
    high[2] = this.layers[this.layers.length - 1].z;
    return { low, high, middle: low.map((v, k) => (v + high[k]) / 2) };
  }

  widest() {
    return this.wide.reduce((widest, width) => Math.max(widest, width), 0);
  }

  // Where the strand is at a place.
  at(place) {
    const k = Math.min(this.moves, Math.max(0, Math.ceil(place)));
    const before = Math.max(0, k - 1), share = 1 - (k - place);
    const mix = (values) => values[before] + (values[k] - values[before]) * share;
    return [mix(this.x), mix(this.y), mix(this.z)];
  }

  // An amount that grows along the strand (length or time) at a place, and the place at which it is reached.
  amountAt(amounts, place) {
    const k = Math.min(this.moves, Math.max(0, Math.ceil(place)));
    const before = Math.max(0, k - 1);
    return amounts[before] + (amounts[k] - amounts[before]) * (1 - (k - place));
  }

  placeOf(amounts, amount) {
    let low = 0, high = this.moves;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (amounts[middle] < amount) low = middle + 1; else high = middle;
    }
    if (low === 0) return 0;
    const step = amounts[low] - amounts[low - 1];
    const share = step > 0 ? Math.min(1, (amount - amounts[low - 1]) / step) : 1;
    return low - 1 + share;
  }

  layerAt(place) {
    return this.moves === 0 ? 0 : this.layerOf[Math.min(this.moves, Math.max(1, Math.ceil(place)))];
  }
}
