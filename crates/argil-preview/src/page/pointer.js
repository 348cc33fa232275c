// Mouse, pen and fingers on the canvas: one turns, two (or the right button, or Shift) move and pinch.

class Pointers {
  constructor(element, camera, changed) {
    this.camera = camera;
    this.changed = changed;
    this.down = new Map();
    this.element = element;
    element.addEventListener("pointerdown", (event) => {
      // A pointer of a script's making cannot be captured.
      if (event.isTrusted) element.setPointerCapture(event.pointerId);
      this.down.set(event.pointerId, this.place(event));
      element.focus({ preventScroll: true });
    });
    element.addEventListener("pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel"]) {
      element.addEventListener(name, (event) => this.down.delete(event.pointerId));
    }
    element.addEventListener("contextmenu", (event) => event.preventDefault());
    element.addEventListener("wheel", (event) => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 30 : 1;
      camera.zoom(Math.exp(-event.deltaY * lines * 0.0015), ...this.place(event));
      changed();
    }, { passive: false });
  }

  place(event) {
    const box = this.element.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  move(event) {
    const before = this.down.get(event.pointerId);
    if (!before) return;
    const now = this.place(event);
    const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    const others = [...this.down].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
    if (others.length > 0) {
      const other = others[0];
      const gap = (place) => Math.hypot(place[0] - other[0], place[1] - other[1]) || 1;
      this.camera.zoom(gap(now) / gap(before), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
      // Each finger moves the middle between both by half of its way.
      this.camera.pan(dx / 2, dy / 2);
    } else if (event.shiftKey || event.ctrlKey || (event.buttons & 6) !== 0) {
      this.camera.pan(dx, dy);
    } else {
      this.camera.orbit(dx, dy);
    }
    this.down.set(event.pointerId, now);
    this.changed();
  }
}
