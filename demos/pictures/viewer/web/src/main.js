// SPDX-License-Identifier: MIT
import { follow, keepAddress, wishes } from "./address.js";
import { Frames, unpacked } from "./frames.js";
import { Viewer } from "./viewer.js";

async function worldsOfPage() {
  const worlds = [];
  for (let number = 0; document.getElementById(`world-${number}`); ++number) {
    const run = JSON.parse(new TextDecoder().decode(await unpacked(`world-${number}`)));
    worlds.push({ run, frames: new Frames(run, number) });
  }
  return worlds;
}

/** The step that the address asks for is the only one that is waited for. */
async function start() {
  const worlds = await worldsOfPage();
  const viewer = new Viewer(worlds, await Promise.all(worlds.map(({ frames }) => frames.load(0))), wishes().has("plain"));
  await follow(viewer);
  document.getElementById("loading").hidden = true;
  let last = performance.now();
  const loop = (now) => {
    requestAnimationFrame(loop);
    viewer.tick((now - last) / 1000);
    last = now;
  };
  requestAnimationFrame(loop);
  keepAddress(viewer);
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
