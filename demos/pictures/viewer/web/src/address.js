// SPDX-License-Identifier: MIT

/**
 * What the address asks for behind its "#": step=N, colour=MODE, boxes, pairs, paused, plain (see Viewport), and closer: look
 * at what moves in that step rather than at all that is going to happen.
 */
export const wishes = () => new URLSearchParams(location.hash.replace(/^#/, ""));

/** All but "plain", which is for the beginning. */
export async function follow(viewer) {
  const asked = wishes();
  const colour = asked.get("colour");
  if (colour in viewer.colours.modes) viewer.setColour(colour);
  for (const overlay of ["boxes", "pairs"]) if (asked.has(overlay)) viewer.setOverlay(overlay, true);
  if (asked.has("step")) viewer.player.goToStep(Number(asked.get("step")) || 0);
  else if (!asked.has("paused")) viewer.player.toggle();
  if (!asked.has("closer")) return;
  await viewer.frames.load(viewer.player.frame);
  viewer.show();
  viewer.frameAll();
}
