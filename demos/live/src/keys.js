// SPDX-License-Identifier: MIT
import { element } from "./panel.js";

/** Keys and what they do: [key, what the help calls it, what the help says, action]. */
const keysOf = (live) => [
  [" ", "space", "pause, go on", () => live.change({ paused: !live.settings.paused })],
  [".", ".", "one frame", () => live.single()],
  ["ArrowRight", "\u2192", "more boxes", () => live.panel.more(1)],
  ["ArrowLeft", "\u2190", "fewer boxes", () => live.panel.more(-1)],
  ["ArrowUp", "\u2191", "larger boxes", () => live.panel.larger(1)],
  ["ArrowDown", "\u2193", "smaller boxes", () => live.panel.larger(-1)],
  ["i", "I", "the next input", () => live.panel.another("input")],
  ["m", "M", "the next motion", () => live.panel.another("motion")],
  ["e", "E", "World or findPairs", () => live.panel.another("engine")],
  ["v", "V", "show pairs, new ones, overlaps", () => live.panel.another("view")],
  ["r", "R", "race the npm packages, or stop them", () => live.race()],
  ["x", "X", "plant a wrong pair: the check is to notice", () => live.spoil()],
  ["f", "F", "look at all of it", () => live.stage.fit()],
  ["o", "O", "turn slowly, or stand still", () => live.change({ turn: !live.settings.turn })],
  ["t", "T", "light or dark", () => live.otherTheme()],
  ["l", "L", "copy a link to what you see", () => live.share()],
  ["?", "?, H", "this text", () => element("helptext").showModal()],
  ["Escape", "Esc", "close this text, let go of the box", () => live.select(-1)],
];

export function watchKeys(live) {
  const keys = keysOf(live);
  const actions = Object.fromEntries(keys.map(([key, , , act]) => [key, act]));
  actions.h = actions["?"];
  element("keys").append(
    ...keys.flatMap(([, name, says]) => {
      const term = document.createElement("dt");
      term.append(Object.assign(document.createElement("kbd"), { textContent: name }));
      return [term, Object.assign(document.createElement("dd"), { textContent: says })];
    }),
  );
  // A button that was clicked is not to take the space bar after that.
  document.addEventListener("click", ({ detail, target }) => detail > 0 && target.closest("button")?.blur());
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || element("helptext").open) return;
    // Arrows and the space bar belong to what has the focus.
    if (event.key === " " && event.target.tagName === "BUTTON") return;
    if (event.key.startsWith("Arrow") && event.target.tagName === "INPUT") return;
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
