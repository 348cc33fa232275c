// The page: what is shown, and what changes it.

const element = (id) => document.getElementById(id);
const millimetres = (length) => (length >= 1000 ? `${(length / 1000).toFixed(2)} m` : `${length.toFixed(0)} mm`);

// How long after the last change the view counts as still, milliseconds.
const STILL = 180;

// Time that a frame may take while the view moves, milliseconds, before it is drawn with fewer pixels.
const SLOW = 50;

class Page {
  constructor(plan) {
    this.plan = plan;
    this.place = plan.moves;
    this.lower = 0;
    this.mode = "role";
    this.hidden = new Set();
    this.focus = null;
    this.density = 1;
    this.camera = new Camera(plan.box);
    this.colours = new Colours(plan);
    this.player = new Player(plan);
    this.view = this.viewOf(location.hash.slice(1));
    this.marks = new MarkList(plan, element("marks"), (mark) => this.jump(mark));
    this.tell();
    this.connect();
    this.recolour();
    this.view.show((move) => !this.hidden.has(plan.role[move]));
    this.resize();
    this.camera.fit();
  }

  // By a graphics card where there is one; `#webgl` and `#canvas` after the page's name ask for one or the other.
  viewOf(wanted) {
    const solid = wanted === "canvas" ? null : SolidView.on(element("view"), this.plan, wanted === "webgl");
    if (solid) return solid;
    // A canvas that has been asked for WebGL may give no other context, so a new one takes its place.
    const old = element("view");
    const canvas = old.cloneNode();
    old.replaceWith(canvas);
    return new RasterView(canvas, this.plan);
  }

  tell() {
    const { plan } = this;
    element("title").textContent = plan.title;
    const length = plan.length[plan.moves];
    const facts = [
      ["layers", String(plan.layers.length)],
      ["strand", millimetres(length)],
      ["printing", duration(plan.time[plan.moves])],
      ...plan.facts,
      ["drawn by", this.view.name],
    ];
    for (const [name, value] of facts) {
      const row = element("facts").tBodies[0].insertRow();
      row.insertCell().textContent = name;
      row.insertCell().textContent = value;
    }
    if (plan.moves < plan.wholeMoves && plan.off > 0) {
      this.standing = `A large plan: drawn with ${plan.moves} of ${plan.wholeMoves} moves, `
        + `at most ${plan.off.toPrecision(2)} mm off.`;
    }
  }

  connect() {
    const { plan } = this;
    const on = (id, event, act) => element(id).addEventListener(event, act);
    for (const id of ["upper", "lower"]) element(id).max = plan.layers.length - 1;
    on("upper", "input", (event) => this.showTo(plan.layers[Number(event.target.value)].last));
    on("lower", "input", (event) => this.showFrom(Number(event.target.value)));
    on("place", "input", (event) => {
      this.showTo(plan.placeOf(plan.length, plan.length[plan.moves] * Number(event.target.value) / 10000));
    });
    on("play", "click", () => this.play(!this.player.playing));
    on("speed", "input", (event) => this.setSpeed(Number(event.target.value)));
    on("mode", "change", (event) => this.colourBy(event.target.value));
    for (const button of document.querySelectorAll("[data-view]")) {
      button.addEventListener("click", () => this.look(button.dataset.view));
    }
    this.setSpeed(Number(element("speed").value));
    new Pointers(element("view"), this.camera, () => this.changed(true));
    document.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.resize()).observe(element("stage"));
    const dark = matchMedia("(prefers-color-scheme: dark)");
    dark.addEventListener("change", () => this.changed());
    this.view.restored = () => {
      this.recolour();
      this.showRoles();
    };
  }

  resize() {
    const stage = element("stage");
    const before = [this.camera.width, this.camera.height];
    this.camera.resize(Math.max(1, stage.clientWidth), Math.max(1, stage.clientHeight));
    if (before[0] === 1) this.camera.fit();
    this.changed();
  }

  // What is shown -----------------------------------------------------------------------------------------------

  showTo(place) {
    this.place = Math.min(this.plan.moves, Math.max(0, place));
    this.lower = Math.min(this.lower, this.plan.layerAt(this.place));
    this.changed();
  }

  showFrom(layer) {
    this.lower = Math.min(this.plan.layers.length - 1, Math.max(0, layer));
    const { first, last } = this.plan.layers[this.lower];
    if (this.place < first) this.place = last;
    this.changed();
  }

  colourBy(mode) {
    this.mode = mode;
    element("mode").value = mode;
    this.recolour();
  }

  recolour() {
    const { tones, table, legend } = this.colours.of(this.mode);
    this.view.colour(tones, table);
    this.tellColours(legend, table);
    this.changed();
  }

  showRoles() {
    const { plan, hidden } = this;
    this.view.show((move) => !hidden.has(plan.role[move]));
    this.changed();
  }

  setSpeed(value) {
    this.player.slider = value;
    element("speed-text").textContent = this.player.factor;
  }

  play(playing) {
    if (playing && this.place >= this.plan.moves) this.place = this.plan.layers[this.lower].first - 1;
    this.player.playing = playing;
    this.last = null;
    this.changed();
  }

  look(view) {
    const { camera } = this;
    if (view === "help") {
      const help = element("help");
      help.hidden = !help.hidden;
      document.querySelector("[data-view=help]").setAttribute("aria-expanded", String(!help.hidden));
      return;
    }
    if (view === "top") [camera.azimuth, camera.elevation] = [0, 90];
    if (view === "front") [camera.azimuth, camera.elevation] = [0, 0];
    if (view === "below") camera.elevation = -40;
    camera.fit();
    this.changed();
  }

  // Leads to a mark: shows its layer uppermost and its place in the middle, near enough to see beads.
  jump(mark) {
    const { plan, camera } = this;
    const layer = plan.layers[mark.layer];
    this.focus = mark;
    this.player.playing = false;
    this.lower = Math.min(this.lower, mark.layer);
    this.place = layer.last;
    if (mark.x !== null) {
      camera.target = [mark.x, mark.y, layer.z];
      camera.elevation = Math.max(camera.elevation, 40);
      camera.scale = Math.max(camera.scale, Math.min(camera.width, camera.height) / (24 * layer.width));
    }
    this.changed();
  }

  // What the panel says --------------------------------------------------------------------------------------------

  tellColours(legend, table) {
    const box = element("legend");
    box.replaceChildren();
    const line = (colour, text) => {
      const label = document.createElement("label");
      const swatch = document.createElement("span");
      swatch.className = "swatch";
      swatch.style.background = css(colour);
      label.append(swatch, text);
      box.append(label);
      return label;
    };
    if (legend.kind === "ramp") {
      const ramp = document.createElement("div");
      ramp.className = "ramp";
      ramp.style.background = `linear-gradient(to right, ${RAMP.map(css).join(", ")})`;
      const ends = document.createElement("div");
      ends.className = "ends";
      for (const value of [legend.low, legend.high]) {
        const end = document.createElement("span");
        end.textContent = `${Number(value.toPrecision(3))} ${legend.unit}`;
        ends.append(end);
      }
      box.append(ramp, ends);
    } else if (legend.kind === "marks") {
      line(PLAIN, "nothing found");
      line(NOTE, "note");
      line(FAULT, "fault");
    } else {
      this.plan.roles.forEach((role, k) => this.roleLine(line, role, k, table[k]));
    }
  }

  roleLine(line, role, k, colour) {
    const { plan, hidden } = this;
    let length = 0;
    for (let move = 1; move <= plan.moves; move++) {
      if (plan.role[move] === k) length += plan.length[move] - plan.length[move - 1];
    }
    if (length === 0) return;
    const label = line(colour, role.name);
    const box = document.createElement("input");
    box.type = "checkbox";
    box.checked = !hidden.has(k);
    box.dataset.role = role.name;
    box.addEventListener("change", () => {
      if (box.checked) hidden.delete(k); else hidden.add(k);
      this.showRoles();
    });
    const text = document.createElement("output");
    text.className = "length";
    text.textContent = millimetres(length);
    label.prepend(box);
    label.append(text);
  }

  tellPlace() {
    const { plan, place } = this;
    const upper = plan.layerAt(place);
    const name = (layer) => `${plan.layers[layer].index} (z ${plan.layers[layer].z.toFixed(2)} mm)`;
    element("upper").value = upper;
    element("lower").value = this.lower;
    element("upper-text").textContent = name(upper);
    element("lower-text").textContent = name(this.lower);
    const laid = plan.amountAt(plan.length, place);
    element("place").value = Math.round(10000 * laid / (plan.length[plan.moves] || 1));
    element("place-text").textContent = `${millimetres(laid)}, ${duration(plan.amountAt(plan.time, place))}`;
    element("play").textContent = this.player.playing ? "Pause" : "Play";
    element("play").setAttribute("aria-pressed", String(this.player.playing));
  }

  put(marker, point) {
    marker.hidden = point === null;
    if (point) marker.style.transform = `translate(${point[0].toFixed(1)}px, ${point[1].toFixed(1)}px)`;
  }

  tellMarkers() {
    const { plan, camera, focus, place } = this;
    const marked = focus !== null && focus.x !== null && plan.layerAt(place) >= focus.layer;
    this.put(element("ring"), marked ? camera.onScreen([focus.x, focus.y, plan.layers[focus.layer].z]) : null);
    const laying = place > 0 && place < plan.moves && place !== plan.layers[plan.layerAt(place)].last;
    this.put(element("nozzle"), laying || this.player.playing ? camera.onScreen(plan.at(place)) : null);
    this.drawScale();
  }

  // A bar of a round length in the corner.
  drawScale() {
    const room = 140 / this.camera.scale;
    const decade = 10 ** Math.floor(Math.log10(room));
    const length = [5, 2, 1].map((k) => k * decade).find((v) => v <= room) ?? decade;
    const y = this.camera.height - 34;
    const bar = document.createElementNS(element("bed").namespaceURI, "path");
    bar.setAttribute("d", `M12 ${y - 6}V${y}H${12 + length * this.camera.scale}V${y - 6}`);
    const text = document.createElementNS(bar.namespaceURI, "text");
    text.setAttribute("x", 12 + length * this.camera.scale + 6);
    text.setAttribute("y", y);
    text.textContent = `${Number(length.toPrecision(2))} mm`;
    element("bed").replaceChildren(bar, text);
  }

  // Drawing --------------------------------------------------------------------------------------------------------

  // Something is no longer as drawn; by the hand of a user, it probably goes on changing.
  changed(byHand = false) {
    if (byHand) this.touched = performance.now();
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame((now) => this.frame(now));
  }

  frame(now) {
    this.waiting = false;
    const { player } = this;
    if (player.playing) {
      const seconds = this.last === null ? 0 : Math.min(0.2, (now - this.last) / 1000);
      this.place = player.next(this.place, seconds);
    }
    this.last = now;
    const moving = player.playing || now - (this.touched ?? -Infinity) < STILL;
    this.pace(now, moving);
    this.draw(moving);
    this.tellPlace();
    this.tellMarkers();
    if (moving) this.changed();
  }

  // Fewer pixels while moving where frames take long, all of them when still.
  pace(now, moving) {
    if (moving && this.wasMoving) {
      this.slow = 0.8 * (this.slow ?? SLOW / 2) + 0.2 * (now - this.drawnAt);
      if (this.slow > SLOW && this.density > 0.5) {
        this.density = Math.max(0.5, this.density * 0.8);
        this.slow = SLOW / 2;
      }
    }
    this.wasMoving = moving;
    this.drawnAt = now;
  }

  draw(moving) {
    const { plan, camera } = this;
    const screen = Math.min(2, globalThis.devicePixelRatio || 1);
    // What a graphics card smoothes by itself is drawn larger here, once it stands still.
    const full = this.view instanceof RasterView ? 2 : screen;
    const density = moving ? Math.min(full, screen, this.density) : full;
    const background = this.background();
    const first = plan.layers[this.lower].first;
    const last = Math.ceil(this.place);
    this.drawn = last >= first && last > 0
      ? this.view.draw(camera, first, last, { density, background, moving })
      : this.view.draw(camera, 1, 0, { density, background, moving });
    const notes = [this.standing];
    if (moving && density < 1) notes.push("Coarser while it moves.");
    element("notice").textContent = notes.filter(Boolean).join(" ");
  }

  background() {
    const colour = getComputedStyle(document.documentElement).getPropertyValue("--ground").trim();
    return parseColour(colour);
  }

  // Keys -----------------------------------------------------------------------------------------------------------

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    // Sliders and lists have their own use for the arrows.
    const own = event.target.closest?.("input, select, summary, button");
    const act = this.action(event, own !== null && own !== undefined);
    if (!act) return;
    event.preventDefault();
    act();
  }

  action(event, inControl) {
    const { plan, camera } = this;
    const turn = (dx, dy) => () => { camera.orbit(dx, dy); this.changed(true); };
    const layers = (by) => () => {
      const to = Math.min(plan.layers.length - 1, Math.max(0, plan.layerAt(this.place) + by));
      this.showTo(plan.layers[to].last);
    };
    const arrows = event.shiftKey
      ? { ArrowLeft: turn(-20, 0), ArrowRight: turn(20, 0), ArrowUp: turn(0, 20), ArrowDown: turn(0, -20) }
      : {
        ArrowUp: layers(1), ArrowDown: layers(-1), PageUp: layers(10), PageDown: layers(-10),
        ArrowLeft: () => this.showTo(Math.ceil(this.place) - 1),
        ArrowRight: () => this.showTo(Math.floor(this.place) + 1),
        Home: () => this.showTo(plan.layers[0].last), End: () => this.showTo(plan.moves),
        " ": () => this.play(!this.player.playing),
      };
    const zoom = (factor) => () => { camera.zoom(factor); this.changed(true); };
    const letters = {
      "+": zoom(1.25), "=": zoom(1.25), "-": zoom(0.8), "−": zoom(0.8),
      n: () => this.marks.step(1), p: () => this.marks.step(-1),
      f: () => this.look("fit"), t: () => this.look("top"), "?": () => this.look("help"),
    };
    MODES.forEach((mode, k) => { letters[k + 1] = () => this.colourBy(mode); });
    return letters[event.key.toLowerCase()] ?? (inControl ? undefined : arrows[event.key]);
  }
}

const page = new Page(new Plan(JSON.parse(element("plan").textContent)));
// For scripts and tests.
globalThis.argil = page;
