// SPDX-License-Identifier: MIT
// What the address asks for behind its "#", and the address of what is shown: step=N, colour=MODE, boxes, pairs, contacts,
// nojoints, select=OBJECT, chase, theme=light|dark, camera=X,Y,Z,X,Y,Z (where it is, where it looks), paused, plain.

export const wishes = () => new URLSearchParams(location.hash.replace(/^#/, ""));

const numbers = (text) => (text ?? "").split(",").map(Number).filter((x) => Number.isFinite(x));

/** All but "plain", which is for the beginning. Waits for the step. */
export async function follow(viewer) {
  const asked = wishes();
  const { player, theme, worlds } = viewer;
  if (["light", "dark"].includes(asked.get("theme"))) theme.choose(asked.get("theme"));
  if (asked.get("colour") in viewer.modes) viewer.setColour(asked.get("colour"));
  for (const overlay of ["boxes", "pairs", "contacts"]) viewer.setOverlay(overlay, asked.has(overlay));
  viewer.setOverlay("joints", !asked.has("nojoints"));
  if (asked.has("step")) player.goToStep(Number(asked.get("step")) || 0);
  const selected = worlds[0].objects.placeOf(Number(asked.get("select") ?? -1));
  viewer.select(selected);
  await Promise.all(worlds.map((world) => world.frames.load(Math.floor(world.positionOf(player)))));
  viewer.path.open(player);
  viewer.show();
  if (asked.has("chase") && selected >= 0) viewer.chase(selected);
  const camera = numbers(asked.get("camera"));
  if (camera.length === 6) {
    viewer.viewport.camera.position.fromArray(camera);
    viewer.viewport.controls.target.fromArray(camera, 3);
    viewer.viewport.controls.update();
  }
  if (!asked.has("step") && !asked.has("paused") && !player.playing) player.toggle();
}

/** The address of what is shown, from its "#" on. */
export function linkTo(viewer) {
  const { player, overlays, selected, path, viewport, theme, colour, worlds } = viewer;
  const camera = [...viewport.camera.position.toArray(), ...viewport.controls.target.toArray()].map((x) => Number(x.toPrecision(8)));
  const words = [`step=${player.step}`, `colour=${colour}`, ...["boxes", "pairs", "contacts"].filter((name) => overlays[name])];
  if (!overlays.joints) words.push("nojoints");
  if (selected >= 0) words.push(`select=${worlds[0].objects.numberOf(selected)}`);
  if (path.chased >= 0) words.push("chase");
  if (theme.chosen) words.push(`theme=${theme.chosen}`);
  if (wishes().has("plain")) words.push("plain");
  return `#${[...words, `camera=${camera.join(",")}`].join("&")}`;
}

const seldom = 500; // ms

/** The address says what is shown whenever the run stands still, and what somebody types there is shown. */
export function keepAddress(viewer) {
  setInterval(() => {
    const link = linkTo(viewer);
    if (!viewer.player.playing && link !== location.hash) history.replaceState(null, "", link);
  }, seldom);
  addEventListener("hashchange", () => follow(viewer));
}
