// SPDX-License-Identifier: MIT
// The page, or one of its workers; each takes of this script what it needs.

async function showPage() {
  if (!document.createElement("canvas").getContext("webgl2")) {
    document.getElementById("loading").textContent = "This page draws with WebGL 2, which this browser does not have or has switched off.";
    return;
  }
  const { Live } = await import("./live.js");
  const live = new Live();
  const loop = (now) => {
    requestAnimationFrame(loop);
    live.tick(now);
  };
  requestAnimationFrame(loop);
  // For tests.
  window.boxstreamLive = live;
}

const workers = {
  steps: async () => (await import("./step_worker.js")).serveSteps(),
  beside: async () => (await import("./beside_worker.js")).serveBeside(),
};

if (globalThis.document) showPage();
else workers[self.name]();
