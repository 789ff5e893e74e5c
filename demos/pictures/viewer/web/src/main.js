// SPDX-License-Identifier: MIT
import { follow, wishes } from "./address.js";
import { Frames, unpacked } from "./frames.js";
import { Viewer } from "./viewer.js";

async function start() {
  const run = JSON.parse(new TextDecoder().decode(await unpacked("run")));
  const frames = new Frames(run);
  const viewer = new Viewer(run, frames, await frames.load(0), wishes().has("plain"));
  await viewer.open();
  await follow(viewer);
  document.getElementById("loading").hidden = true;
  let last = performance.now();
  const loop = (now) => {
    requestAnimationFrame(loop);
    viewer.tick((now - last) / 1000);
    last = now;
  };
  requestAnimationFrame(loop);
  // For scripts that take pictures, and for tests.
  window.boxstreamViewer = viewer;
}

start().catch((error) => {
  const box = document.getElementById("problem");
  box.textContent = `This run cannot be shown: ${error.message}`;
  box.hidden = false;
  document.getElementById("loading").hidden = true;
  console.error(error);
});
