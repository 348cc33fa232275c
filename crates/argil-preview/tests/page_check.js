// Uses the controls of a preview page and leaves a verdict in it; .ci/page puts this at the page's end.
"use strict";
(() => {
  const page = globalThis.argil;
  const find = (selector) => document.querySelector(selector);

  // The picture of now, as text.
  const picture = () => {
    page.frame(performance.now());
    page.draw(false);
    return find("#view").toDataURL();
  };
  const use = (selector, value, event = "input") => {
    find(selector).value = value;
    find(selector).dispatchEvent(new Event(event));
  };
  const press = (key, more = {}) => document.dispatchEvent(new KeyboardEvent("keydown", { key, ...more }));
  const expect = (holds, what) => { if (!holds) throw new Error(what); };
  const changes = (what, act) => {
    const before = picture();
    act();
    expect(picture() !== before, `${what} does not change the picture`);
  };

  const wanted = { webgl: "WebGL 2", canvas: "canvas" }[location.hash.slice(1)];
  const steps = () => {
    expect(page, "the page's program has not run");
    expect(page.view.name === wanted, `drawn by ${page.view.name} instead of ${wanted}`);
    expect(page.plan.moves > 100 && page.plan.layers.length > 10, "there is no plan");
    expect(page.drawn === undefined || page.drawn > 0, "nothing is drawn");

    const whole = picture();
    changes("the layer slider", () => use("#upper", 5));
    expect(find("#upper-text").textContent.startsWith("5 "), "the layer is not told");
    changes("the lower slider", () => use("#lower", 4));
    use("#lower", 0);
    use("#upper", page.plan.layers.length - 1);
    expect(picture() === whole, "the whole print does not look as at first");

    for (const mode of ["height", "flow", "marks"]) {
      changes(`the colour ${mode}`, () => use("#mode", mode, "change"));
    }
    use("#mode", "role", "change");
    changes("hiding walls", () => find("[data-role=wall]").click());
    changes("showing walls", () => find("[data-role=wall]").click());
    changes("turning by keys", () => press("ArrowLeft", { shiftKey: true }));
    changes("the layer key", () => press("ArrowDown"));
    changes("zooming", () => press("+"));
    changes("the wheel", () => {
      find("#view").dispatchEvent(new WheelEvent("wheel", { deltaY: -300, clientX: 200, clientY: 200 }));
    });
    find("[data-view=fit]").click();
    const finger = (name, id, x, y) => {
      find("#view").dispatchEvent(new PointerEvent(name, { pointerId: id, clientX: x, clientY: y, buttons: 1 }));
    };
    changes("one finger", () => {
      finger("pointerdown", 1, 100, 100);
      finger("pointermove", 1, 160, 100);
    });
    changes("two fingers", () => {
      finger("pointerdown", 2, 300, 300);
      finger("pointermove", 2, 320, 310);
      finger("pointerup", 1, 160, 100);
      finger("pointerup", 2, 320, 310);
    });

    // Frames in motion may be coarser, but show the same.
    find("[data-view=fit]").click();
    page.density = 0.5;
    page.draw(true);
    expect(find("#view").width < page.camera.width, "frames that come late are not drawn with fewer pixels");
    expect(find("#notice").textContent.includes("Coarser"), "nothing tells that it is coarser");
    page.density = 1;
    page.draw(false);
    expect(find("#view").width >= page.camera.width, "it stays coarse when it stands still");
    if (page.view.image) {
      const pixels = (moving) => {
        const whole = [1, page.plan.moves, { density: 1, background: page.background(), moving }];
        page.view.draw(page.camera, ...whole);
        return page.view.image.data.slice();
      };
      const [still, fast] = [pixels(false), pixels(true)];
      const paper = page.background();
      let drawn = 0, other = 0;
      for (let k = 0; k < still.length; k += 4) {
        const off = (a, b) => [0, 1, 2].some((c) => Math.abs(a[k + c] - (b === paper ? paper[c] : b[k + c])) > 48);
        if (off(still, paper)) drawn++;
        if (off(still, fast)) other++;
      }
      expect(drawn > 1000 && other < 0.03 * drawn, `${other} of ${drawn} pixels look otherwise in motion`);
    }

    find("[data-view=fit]").click();
    use("#place", 3000);
    changes("playing", () => {
      const before = page.place;
      page.play(true);
      page.frame(1000);
      page.frame(1500);
      expect(page.place > before, "playing does not go on");
      page.play(false);
    });

    const list = page.marks.order;
    expect(list.length > 0, "there are no findings to be led to");
    const group = find("#marks details");
    group.open = true;
    group.dispatchEvent(new Event("toggle"));
    const first = group.querySelector("[data-mark]");
    changes("a finding", () => first.click());
    expect(first.getAttribute("aria-current") === "true", "the finding is not marked as the current one");
    const mark = page.focus;
    expect(page.plan.layerAt(page.place) === mark.layer, "its layer is not the uppermost");
    if (mark.x !== null) {
      const [x, y] = page.camera.onScreen([mark.x, mark.y, page.plan.layers[mark.layer].z]);
      const off = Math.hypot(x - page.camera.width / 2, y - page.camera.height / 2);
      expect(off < 1 && !find("#ring").hidden, "its place is not ringed in the middle");
    }
    if (list.length > 1) {
      press("n");
      expect(page.focus !== mark, "the next finding is not led to");
    }
    expect(page.view.gl === undefined || page.view.gl.getError() === 0, "WebGL has an error");
  };

  const verdict = document.createElement("p");
  verdict.id = "verdict";
  document.body.append(verdict);
  try {
    steps();
    verdict.textContent = "as it should be";
  } catch (error) {
    verdict.textContent = String(error.message);
  }
})();
