// What colour each move has: a number from 0 to 255 into a ramp of colours.

const MODES = ["role", "height", "flow", "marks"];

// From dark blue by green to yellow, rising in lightness throughout, so that it also reads in grey.
const RAMP = [[0x2d, 0x2a, 0x5e], [0x2c, 0x5f, 0x8a], [0x2f, 0x92, 0x8c], [0x7d, 0xbd, 0x6a], [0xf3, 0xdf, 0x5b]];
const PLAIN = [0xb9, 0xaf, 0xa6];
const FAULT = [0xd6, 0x1f, 0x3a];
const NOTE = [0xe0, 0x8a, 0x1e];

function parseColour(text) {
  return [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16));
}

function onRamp(share) {
  const at = Math.min(0.9999, Math.max(0, share)) * (RAMP.length - 1);
  const k = Math.floor(at);
  return RAMP[k].map((v, axis) => Math.round(v + (RAMP[k + 1][axis] - v) * (at - k)));
}

class Colours {
  constructor(plan) {
    this.plan = plan;
    this.marked = this.movesNearMarks();
  }

  // Moves within half a mark's length of it, or within a bead's width: 0 for none, 1 for a note, 2 for a fault.
  movesNearMarks() {
    const plan = this.plan;
    const marked = new Uint8Array(plan.moves + 1);
    for (const kind of plan.kinds) {
      for (const mark of kind.marks) {
        if (mark.x === null) continue;
        const { width, first } = plan.layers[mark.layer];
        const { last } = plan.layers[mark.last];
        // A length is that of all its layers together.
        const length = kind.unit === "mm" ? mark.measure / (mark.last - mark.layer + 1) : 0;
        const reach = Math.max(width, length / 2);
        for (let k = first; k <= last; k++) {
          if (this.distance(k, mark.x, mark.y) <= reach) marked[k] = Math.max(marked[k], kind.fault ? 2 : 1);
        }
      }
    }
    return marked;
  }

  distance(k, x, y) {
    const { x: xs, y: ys } = this.plan;
    const dx = xs[k] - xs[k - 1], dy = ys[k] - ys[k - 1];
    const square = dx * dx + dy * dy;
    const along = square > 0 ? ((x - xs[k - 1]) * dx + (y - ys[k - 1]) * dy) / square : 0;
    const t = Math.min(1, Math.max(0, along));
    return Math.hypot(xs[k - 1] + t * dx - x, ys[k - 1] + t * dy - y);
  }

  // Paste in mm³/s along a move: its bead, with round sides, at the layer's speed.
  flow(move) {
    const { speed } = this.plan.layers[this.plan.layerOf[move]];
    const [width, height] = [this.plan.wide[move], this.plan.bead[move]];
    const area = width > height ? height * (width - height) + Math.PI * height * height / 4
      : Math.PI * width * width / 4;
    return area * speed;
  }

  // The tone of every move, the colour of every tone, and what the legend says.
  of(mode) {
    const plan = this.plan;
    const tones = new Uint8Array(plan.moves + 1);
    const table = Array.from({ length: 256 }, (_, k) => onRamp(k / 255));
    if (mode === "role") {
      tones.set(plan.role);
      plan.roles.forEach((role, k) => { table[k] = parseColour(role.colour); });
      return { tones, table, legend: { kind: "roles" } };
    }
    if (mode === "marks") {
      tones.set(this.marked);
      [PLAIN, NOTE, FAULT].forEach((colour, k) => { table[k] = colour; });
      return { tones, table, legend: { kind: "marks" } };
    }
    const values = new Float64Array(plan.moves + 1);
    let low = Infinity, high = -Infinity;
    for (let k = 1; k <= plan.moves; k++) {
      values[k] = mode === "height" ? plan.z[k] : this.flow(k);
      low = Math.min(low, values[k]);
      high = Math.max(high, values[k]);
    }
    const span = high > low ? high - low : 1;
    for (let k = 1; k <= plan.moves; k++) tones[k] = Math.round(255 * (values[k] - low) / span);
    return { tones, table, legend: { kind: "ramp", low, high, unit: mode === "height" ? "mm" : "mm³/s" } };
  }
}

// From the upper left behind the eye, whichever way it looks.
function lightFrom({ right, up, eye }) {
  const sum = [0, 1, 2].map((k) => -0.55 * right[k] + 0.45 * up[k] + 0.7 * eye[k]);
  const length = Math.hypot(...sum);
  return sum.map((v) => v / length);
}

function css(colour) {
  return `rgb(${colour.map((v) => Math.round(v)).join(" ")})`;
}
