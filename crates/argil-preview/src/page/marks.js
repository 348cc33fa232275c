// The list of findings: a group for each kind, an entry for each place, which leads there.

// Entries that a group shows at first, and more of at each asking: lists of thousands would make the page slow.
const AT_ONCE = 100;

class MarkList {
  constructor(plan, element, jump) {
    this.plan = plan;
    this.jump = jump;
    this.current = -1;
    this.buttons = new Map();
    // In the order of the list: the largest of each kind first.
    this.order = [];
    for (const kind of plan.kinds) {
      kind.marks.sort((a, b) => b.measure - a.measure || a.number - b.number);
      this.order.push(...kind.marks);
      element.append(this.group(kind));
    }
    if (this.order.length === 0) element.textContent = "none";
  }

  group(kind) {
    const details = document.createElement("details");
    const summary = document.createElement("summary");
    const name = document.createElement("span");
    name.textContent = kind.name;
    name.className = kind.fault ? "fault" : "note";
    summary.append(name, ` (${kind.marks.length})`);
    const list = document.createElement("ol");
    details.append(summary, list);
    const fill = () => this.more(kind, list);
    details.addEventListener("toggle", () => { if (list.childElementCount === 0) fill(); });
    kind.open = (position) => {
      details.open = true;
      while (list.querySelectorAll("[data-mark]").length <= position && this.more(kind, list));
    };
    return details;
  }

  more(kind, list) {
    list.querySelector(".more")?.remove();
    const shown = list.childElementCount;
    for (const mark of kind.marks.slice(shown, shown + AT_ONCE)) {
      const button = this.entry(this.label(kind, mark), () => this.go(mark));
      button.dataset.mark = mark.number;
      this.buttons.set(mark, button);
      list.append(this.item(button));
    }
    const left = kind.marks.length - list.childElementCount;
    if (left > 0) {
      const item = this.item(this.entry(`${left} more …`, () => this.more(kind, list)));
      item.className = "more";
      list.append(item);
    }
    return left > 0;
  }

  entry(text, act) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = text;
    button.addEventListener("click", act);
    return button;
  }

  item(button) {
    const item = document.createElement("li");
    item.append(button);
    return item;
  }

  label(kind, mark) {
    const index = (layer) => this.plan.layers[layer].index;
    const layer = mark.last > mark.layer ? `layers ${index(mark.layer)}–${index(mark.last)}` : `layer ${index(mark.layer)}`;
    const place = mark.x === null ? "" : `, at ${mark.x.toFixed(1)} ${mark.y.toFixed(1)}`;
    const unit = kind.unit === "" ? "" : ` ${kind.unit}`;
    return `${layer}${place}: ${Number(mark.measure.toFixed(2))}${unit}`;
  }

  go(mark) {
    this.buttons.get(this.order[this.current])?.removeAttribute("aria-current");
    this.current = this.order.indexOf(mark);
    const kind = this.plan.kinds[mark.kind];
    kind.open(kind.marks.indexOf(mark));
    const button = this.buttons.get(mark);
    button?.setAttribute("aria-current", "true");
    button?.scrollIntoView({ block: "nearest" });
    this.jump(mark);
  }

  // The next or, with -1, the one before; round at the ends.
  step(by) {
    const count = this.order.length;
    if (count === 0) return;
    const from = this.current < 0 && by < 0 ? 0 : this.current;
    this.go(this.order[(from + by + count) % count]);
  }
}
