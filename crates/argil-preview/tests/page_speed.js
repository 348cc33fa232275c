// Times the frames of a preview page at 1280 x 720 and leaves the figures in it; .ci/page-speed puts this at the page's end.
"use strict";
(() => {
  const page = globalThis.argil;
  page.camera.resize(1280, 720);
  page.camera.fit();

  // Milliseconds a frame while the view turns: the least and the middle one of as many as two seconds hold, and at least
  // of three. WebGL draws later than it is told to, unless a pixel is asked for.
  const frames = (density, moving) => {
    const times = [];
    page.density = density;
    const start = performance.now();
    while (times.length < 3 || performance.now() - start < 2000) {
      page.camera.orbit(7, 0.3);
      const before = performance.now();
      page.draw(moving);
      page.view.gl?.readPixels(0, 0, 1, 1, page.view.gl.RGBA, page.view.gl.UNSIGNED_BYTE, new Uint8Array(4));
      times.push(performance.now() - before);
    }
    times.sort((a, b) => a - b);
    return [times[0], times[times.length >> 1]].map((time) => time.toFixed(1)).join(", ");
  };
  frames(1, true);
  const figures = [
    `${page.plan.moves} moves, ${page.plan.layers.length} layers, drawn by ${page.view.name}`,
    `all pixels, in motion: ${frames(1, true)}`,
    `half of them each way, in motion: ${frames(0.5, true)}`,
    `standing still: ${frames(1, false)}`,
  ];
  const verdict = document.createElement("p");
  verdict.id = "verdict";
  verdict.textContent = figures.join("; ");
  document.body.append(verdict);
})();
