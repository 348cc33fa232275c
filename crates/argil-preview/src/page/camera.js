// A parallel view: what is as long looks as long, wherever it is, which suits the judging of a print.
//
// Angles are in degrees: the azimuth turns round the print, the elevation is that of the eye above the horizon, and is
// negative below it. The scale is in pixels to the millimetre.

class Camera {
  constructor(box) {
    this.box = box;
    this.azimuth = 25;
    this.elevation = 32;
    this.scale = 1;
    this.target = box.middle.slice();
    this.width = 1;
    this.height = 1;
  }

  resize(width, height) {
    this.width = width;
    this.height = height;
  }

  // The whole print, a little space round it.
  fit() {
    this.target = this.box.middle.slice();
    const { low, high } = this.box;
    let across = 1e-6, up = 1e-6;
    for (let corner = 0; corner < 8; corner++) {
      const point = low.map((v, k) => (corner >> k & 1 ? high[k] : v));
      const [x, y] = this.relative(point);
      across = Math.max(across, Math.abs(x));
      up = Math.max(up, Math.abs(y));
    }
    this.scale = 0.46 * Math.min(this.width / across, this.height / up);
    this.fitted = this.scale;
  }

  // Unit vectors: to the right on the screen, up on the screen, and towards the eye.
  axes() {
    const a = this.azimuth * Math.PI / 180, e = this.elevation * Math.PI / 180;
    const [sa, ca, se, ce] = [Math.sin(a), Math.cos(a), Math.sin(e), Math.cos(e)];
    return { right: [ca, sa, 0], up: [-sa * se, ca * se, ce], eye: [sa * ce, -ca * ce, se] };
  }

  relative(point) {
    const { right, up, eye } = this.axes();
    const d = point.map((v, k) => v - this.target[k]);
    return [right, up, eye].map((axis) => axis[0] * d[0] + axis[1] * d[1] + axis[2] * d[2]);
  }

  // Where a point is on the screen, pixels from the upper left corner.
  onScreen(point) {
    const [x, y] = this.relative(point);
    return [this.width / 2 + x * this.scale, this.height / 2 - y * this.scale];
  }

  orbit(dx, dy) {
    this.azimuth = (this.azimuth - dx * 0.4) % 360;
    this.elevation = Math.min(90, Math.max(-90, this.elevation + dy * 0.4));
  }

  pan(dx, dy) {
    const { right, up } = this.axes();
    for (let k = 0; k < 3; k++) this.target[k] += (-dx * right[k] + dy * up[k]) / this.scale;
  }

  // Brings a place of the screen nearer; the place stays where it is.
  zoom(factor, x = this.width / 2, y = this.height / 2) {
    const scale = Math.min(this.fitted * 2000, Math.max(this.fitted / 10, this.scale * factor));
    const dx = this.width / 2 - x, dy = this.height / 2 - y;
    const before = this.scale;
    this.pan(dx, dy);
    this.scale = scale;
    this.pan(-dx, -dy);
    return scale !== before;
  }

  // The view as a matrix of 4 by 4, column by column, for points in millimetres.
  matrix() {
    const { right, up, eye } = this.axes();
    const { low, high } = this.box;
    const reach = Math.hypot(...low.map((v, k) => high[k] - v)) + Math.hypot(...this.relative(this.box.middle)) + 1e-6;
    const scales = [2 * this.scale / this.width, 2 * this.scale / this.height, -1 / reach];
    const rows = [right, up, eye].map((axis, k) => axis.map((v) => v * scales[k]));
    const shift = rows.map((row) => -row.reduce((sum, v, k) => sum + v * this.target[k], 0));
    return [0, 1, 2].flatMap((k) => [rows[0][k], rows[1][k], rows[2][k], 0]).concat(shift, 1);
  }
}
