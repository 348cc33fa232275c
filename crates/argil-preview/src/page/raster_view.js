// Beads in space without a graphics card: pixels are reckoned here and put on a plain canvas.
//
// Software that stands in for a graphics card takes microseconds for each triangle, and a plan has hundreds of
// thousands. Stripes of pixels along each move (bead_tables.js) take less than a tenth of that.

// Cosine of the turn from which on a disc closes the gap at the outer side; up to it, the mitre does.
const NEEDS_DISC = Math.cos(60 * Math.PI / 180);

// How far moves overlap, pixels, so that no hairline shows between them.
const HAIR = 0.5;

// Pixels across for each pixel along, from which on a move is no stripe: it rises between layers.
const TOO_STEEP = 2;

// Moves in a row without such a turn are drawn as one up to this many pixels, and up to so many while the view moves: each
// stripe reaches beyond its ends, so that half as many are drawn in little more than half of the time.
const AT_ONCE_UP_TO = 4;
const AT_ONCE_MOVING = 10;

class RasterView {
  constructor(canvas, plan) {
    this.name = "canvas";
    this.canvas = canvas;
    this.context = canvas.getContext("2d", { alpha: false });
    this.plan = plan;
    const count = plan.moves + 1;
    this.x = new Float32Array(count);
    this.y = new Float32Array(count);
    this.depth = new Float32Array(count);
    this.direction = new Uint8Array(count);
    this.disc = new Uint8Array(count);
    this.gap = new Float32Array(count);
    this.shown = new Uint8Array(count);
    this.directions();
    this.beads();
  }

  // For each move the direction, whether it ends where a disc is needed, and how far beyond its ends it must reach to
  // meet its neighbours at the outer side, in half widths.
  directions() {
    const { plan } = this;
    let before = null;
    for (let k = 1; k <= plan.moves; k++) {
      const dx = plan.x[k] - plan.x[k - 1], dy = plan.y[k] - plan.y[k - 1];
      const length = Math.hypot(dx, dy);
      if (length === 0) {
        this.disc[k] = 1;
        continue;
      }
      const angle = (Math.atan2(dy, dx) / Math.PI + 2) % 1;
      this.direction[k] = Math.min(DIRECTIONS - 1, Math.floor(angle * DIRECTIONS));
      const now = [dx / length, dy / length];
      const cos = before ? before[0] * now[0] + before[1] * now[1] : -1;
      if (cos < NEEDS_DISC) {
        this.disc[k - 1] = 1;
      } else {
        const half = Math.sqrt(Math.max(0, 1 - cos) / (1 + cos));
        this.gap[k - 1] = Math.max(this.gap[k - 1], half);
        this.gap[k] = half;
      }
      before = now;
    }
    this.disc[plan.moves] = 1;
  }

  // Beads of one size share their tables.
  beads() {
    const sizes = new Map();
    this.sizes = [];
    this.sizeOf = new Uint16Array(this.plan.moves + 1);
    for (const { height, first, last } of this.plan.layers) {
      for (let k = first; k <= last; k++) {
        const width = this.plan.wide[k];
        const name = `${width} ${height}`;
        if (!sizes.has(name)) {
          sizes.set(name, this.sizes.length);
          this.sizes.push({ width, height });
        }
        this.sizeOf[k] = sizes.get(name);
      }
    }
  }

  colour(tones, table) {
    this.tones = tones;
    // Bytes lie in the order red, green, blue, opacity on every machine that browsers run on.
    this.shaded = new Uint32Array(table.length * SHADES);
    table.forEach((colour, tone) => {
      for (let shade = 0; shade < SHADES; shade++) {
        this.shaded[tone * SHADES + shade] = packed(colour.map((v) => v * lightOf(shade)));
      }
    });
  }

  show(shown) {
    for (let k = 1; k <= this.plan.moves; k++) this.shown[k] = shown(k) ? 1 : 0;
  }

  draw(camera, first, last, { density, background, moving }) {
    const [width, height] = [camera.width * density, camera.height * density].map(Math.round);
    if (this.image?.width !== width || this.image.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
      this.image = this.context.createImageData(width, height);
      this.pixels = new Uint32Array(this.image.data.buffer);
      this.near = new Float32Array(width * height);
    }
    this.pixels.fill(packed(background));
    this.near.fill(-Infinity);
    this.atOnce = moving ? AT_ONCE_MOVING : AT_ONCE_UP_TO;
    const scale = camera.scale * density;
    const axes = camera.axes();
    const light = lightFrom(axes);
    const tables = this.sizes.map(() => null);
    const { plan } = this;
    this.place(camera, scale, width, height, first, last);
    // What hides comes first, so that the hidden is only compared and not written.
    const [low, high] = [plan.layerAt(first), plan.layerAt(last)];
    for (let step = 0; step <= high - low && last >= first; step++) {
      const k = camera.elevation >= 0 ? high - step : low + step;
      const layer = plan.layers[k];
      const end = Math.min(last, layer.last);
      for (let begin = Math.max(first, layer.first), next; begin <= end; begin = next) {
        const size = this.sizeOf[begin];
        next = begin + 1;
        while (next <= end && this.sizeOf[next] === size) next++;
        const { width: wide, height: tall } = this.sizes[size];
        tables[size] ??= new BeadTables(wide, tall, scale, axes, light);
        this.layer(tables[size], begin, next - 1, last);
      }
    }
    this.context.putImageData(this.image, 0, 0);
    return Math.max(0, last - first + 1);
  }

  // The middle of the bead at every point, in pixels.
  place(camera, scale, width, height, first, last) {
    const { plan, x, y, depth } = this;
    const { right, up, eye } = camera.axes();
    const [tx, ty, tz] = camera.target;
    for (let k = Math.max(0, first - 1); k <= last; k++) {
      const [dx, dy] = [plan.x[k] - tx, plan.y[k] - ty];
      const dz = plan.z[k] - tz - plan.layers[plan.layerOf[k]].height / 2;
      x[k] = width / 2 + scale * (right[0] * dx + right[1] * dy);
      y[k] = height / 2 - scale * (up[0] * dx + up[1] * dy + up[2] * dz);
      depth[k] = scale * (eye[0] * dx + eye[1] * dy + eye[2] * dz);
    }
  }

  // From the last move back to the first; `end` is the last one of all that are shown.
  layer(tables, first, last, end) {
    const { x, y, direction, disc, shown, tones, atOnce } = this;
    const { width, height } = this.image;
    const margin = tables.disc.half + tables.room / 2;
    for (let k = last; k >= first; k--) {
      if (shown[k] === 0) continue;
      const tone = tones[k], x1 = x[k], y1 = y[k];
      let from = k - 1;
      while (from >= first && disc[from] === 0 && tones[from] === tone && shown[from] === 1
        && Math.abs(x[from - 1] - x1) + Math.abs(y[from - 1] - y1) < atOnce) from--;
      const x0 = x[from], y0 = y[from];
      const outside = (x0 < -margin && x1 < -margin) || (x0 > width + margin && x1 > width + margin)
        || (y0 < -margin && y1 < -margin) || (y0 > height + margin && y1 > height + margin);
      if (!outside) {
        const base = tone * SHADES;
        const kind = tables.kind[direction[k]];
        if (kind === ALONG_X) this.alongX(tables, from, k, base);
        else if (kind === ALONG_Y) this.alongY(tables, from, k, base);
        else this.discs(tables, from, k, base);
        if (disc[k] || k === end) this.stamp(tables.disc, x1, y1, this.depth[k], base);
        const begins = from < first || shown[from] === 0 || tones[from] !== tone;
        if (begins && disc[from]) this.stamp(tables.disc, x0, y0, this.depth[from], base);
      }
      k = from + 1;
    }
  }

  // A move towards the eye: discs close behind each other.
  discs(tables, from, to, base) {
    const { x, y, depth } = this;
    const dx = x[to] - x[from], dy = y[to] - y[from], dd = depth[to] - depth[from];
    const steps = Math.min(2000, Math.max(1, Math.ceil(Math.hypot(dx, dy) / Math.max(1, 0.2 * tables.disc.half))));
    for (let j = 0; j <= steps; j++) {
      const t = j / steps;
      this.stamp(tables.disc, x[from] + dx * t, y[from] + dy * t, depth[from] + dd * t, base);
    }
  }

  stamp(disc, x, y, depth, base) {
    const { width, height } = this.image;
    const { near, pixels, shaded } = this;
    const [left, top] = [Math.floor(x) - disc.half, Math.floor(y) - disc.half];
    const [fromV, toV] = [Math.max(0, -top), Math.min(disc.size, height - top)];
    for (let v = fromV; v < toV; v++) {
      const fromU = Math.max(disc.begins[v], -left), toU = Math.min(disc.ends[v], width - left);
      let at = (top + v) * width + left + fromU, from = v * disc.size + fromU;
      for (let u = fromU; u < toU; u++, at++, from++) {
        const d = depth + disc.depth[from];
        if (d > near[at]) {
          near[at] = d;
          pixels[at] = shaded[base + disc.shade[from]];
        }
      }
    }
  }

  // Stripes from top to bottom, one for each column that the move passes.
  alongX(tables, begin, k, base) {
    const { width, height } = this.image;
    const { x, y, depth, near, pixels, shaded } = this;
    const a = x[begin] <= x[k] ? begin : k, b = begin + k - a;
    const x0 = x[a], y0 = y[a], d0 = depth[a];
    const length = x[b] - x0;
    const rise = (y[b] - y0) / length, sink = (depth[b] - d0) / length;
    if (!(Math.abs(rise) < TOO_STEEP)) return this.discs(tables, begin, k, base);
    const bin = this.direction[k];
    const count = tables.count[bin], low = tables.low[bin], start = bin * tables.room;
    const depths = tables.depth, shades = tables.shade, ahead = tables.ahead;
    const beyond = Math.min(this.gap[k] * count / 2, 4 * length) + HAIR;
    const reach = beyond + tables.reach[bin];
    const from = Math.max(0, Math.ceil(x0 - reach - 0.5)), to = Math.min(width - 1, Math.floor(x0 + length + reach - 0.5));
    for (let column = from; column <= to; column++) {
      const along = column + 0.5 - x0;
      const top = Math.floor(y0 + rise * along) + low, d = d0 + sink * along;
      const least = along - length - beyond, most = along + beyond;
      const first = Math.max(0, -top), end = start + Math.min(count, height - top);
      let at = (top + first) * width + column;
      for (let s = start + first; s < end; s++, at += width) {
        const nearer = d + depths[s];
        if (nearer > near[at] && ahead[s] >= least && ahead[s] <= most) {
          near[at] = nearer;
          pixels[at] = shaded[base + shades[s]];
        }
      }
    }
  }

  // Stripes from left to right, one for each row.
  alongY(tables, begin, k, base) {
    const { width, height } = this.image;
    const { x, y, depth, near, pixels, shaded } = this;
    const a = y[begin] <= y[k] ? begin : k, b = begin + k - a;
    const y0 = y[a], x0 = x[a], d0 = depth[a];
    const length = y[b] - y0;
    const rise = (x[b] - x0) / length, sink = (depth[b] - d0) / length;
    if (!(Math.abs(rise) < TOO_STEEP)) return this.discs(tables, begin, k, base);
    const bin = this.direction[k];
    const count = tables.count[bin], low = tables.low[bin], start = bin * tables.room;
    const depths = tables.depth, shades = tables.shade, ahead = tables.ahead;
    const beyond = Math.min(this.gap[k] * count / 2, 4 * length) + HAIR;
    const reach = beyond + tables.reach[bin];
    const from = Math.max(0, Math.ceil(y0 - reach - 0.5)), to = Math.min(height - 1, Math.floor(y0 + length + reach - 0.5));
    for (let row = from; row <= to; row++) {
      const along = row + 0.5 - y0;
      const left = Math.floor(x0 + rise * along) + low, d = d0 + sink * along;
      const least = along - length - beyond, most = along + beyond;
      const first = Math.max(0, -left), end = start + Math.min(count, width - left);
      let at = row * width + left + first;
      for (let s = start + first; s < end; s++, at++) {
        const nearer = d + depths[s];
        if (nearer > near[at] && ahead[s] >= least && ahead[s] <= most) {
          near[at] = nearer;
          pixels[at] = shaded[base + shades[s]];
        }
      }
    }
  }
}

function packed(colour) {
  const [r, g, b] = colour.map((v) => Math.min(255, Math.max(0, Math.round(v))));
  return (255 << 24 | b << 16 | g << 8 | r) >>> 0;
}
