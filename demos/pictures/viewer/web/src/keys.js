// SPDX-License-Identifier: MIT
import { make } from "./dom.js";

/** What keys do: [key, the name on it if that is another, what happens, the action]. */
function table({ player, actions, viewer }) {
  return [
    [" ", "space", "play, pause", actions.play],
    ["ArrowLeft", "\u2190", "a frame back; with shift ten", (by) => player.move(-by)],
    ["ArrowRight", "\u2192", "a frame on; with shift ten", (by) => player.move(by)],
    ["Home", "", "to the beginning", actions.first],
    ["End", "", "to the end", actions.last],
    ["ArrowUp", "\u2191", "faster", () => player.faster(1)],
    ["ArrowDown", "\u2193", "slower", () => player.faster(-1)],
    ["l", "", "begin again at the end", actions.loop],
    ["f", "", "fit what moves, or the followed body, into the view", actions.frame],
    ["c", "", "follow what moves", actions.follow],
    ["t", "", "follow the selected body", actions.chase],
    ["b", "", "boxes of the broad-phase", () => actions.overlay("boxes")],
    ["p", "", "candidate pairs", () => actions.overlay("pairs")],
    ["k", "", "contact points and normals", () => actions.overlay("contacts")],
    ["j", "", "joints", () => actions.overlay("joints")],
    ...Object.entries(viewer.modes).map(([name, { title }], i) => [String(i + 1), "", `colour: ${title}`, () => viewer.setColour(name)]),
    ["/", "", "find a body", actions.search],
    ["v", "", "colours, overlays, search", actions.more],
    ["g", "", "curves", actions.curves],
    ["d", "", "light, dark", actions.theme],
    ["y", "", "copy a link to what is shown", actions.link],
    ["h", "", "this text", actions.help],
    ["Escape", "Esc", "close, select nothing", actions.escape],
  ];
}

const isTyping = (target) => target.matches?.("input[type=search]");

/** Listens to keys, and returns what they do, [name of the key, what], for people. */
export function listenToKeys(context) {
  const all = table(context);
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || (isTyping(event.target) && event.key !== "Escape")) return;
    const key = event.key === "?" ? "h" : event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const found = all.find(([name]) => name === key);
    if (!found) return;
    event.preventDefault();
    found[3](event.shiftKey ? 10 : 1);
  });
  return all.flatMap(([key, name, what]) => {
    const term = make("dt");
    term.append(make("kbd", name || (key.length === 1 ? key.toUpperCase() : key)));
    return [term, make("dd", what)];
  });
}
