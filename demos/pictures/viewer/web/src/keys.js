// SPDX-License-Identifier: MIT
import { linkTo } from "./address.js";
import { element, make } from "./dom.js";

const root = document.documentElement;
const shortWhile = 1500; // ms

async function copyLink(viewer) {
  history.replaceState(null, "", linkTo(viewer));
  const copied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
  element("link").textContent = copied ? "Copied" : "In the address";
  setTimeout(() => (element("link").textContent = "Link"), shortWhile);
}

/** What buttons and keys of `panel` do; those of buttons have their ids. */
export function actionsOf(panel) {
  const { player, viewer } = panel;
  const toggle = (name) => {
    root.classList.toggle(name);
    panel.updateLook();
  };
  return {
    play: () => player.toggle(),
    back: () => player.move(-1),
    on: () => player.move(1),
    first: () => player.move(-Infinity),
    last: () => player.move(Infinity),
    loop: () => {
      player.loop = !player.loop;
      player.onChange();
    },
    overlay: (name) => viewer.setOverlay(name, !viewer.overlays[name]),
    frame: () => viewer.path.fit(player),
    follow: () => viewer.follow(!viewer.path.following),
    chase: () => viewer.selected >= 0 && viewer.chase(viewer.path.chased === viewer.selected ? -1 : viewer.selected),
    more: () => toggle("look"),
    curves: () => toggle("curves"),
    theme: () => viewer.theme.choose(viewer.theme.dark ? "light" : "dark"),
    link: () => copyLink(viewer),
    help: () => (element("helptext").hidden = !element("helptext").hidden),
    search: () => {
      root.classList.add("look");
      panel.updateLook();
      element("wanted").select();
    },
    escape: () => {
      element("wanted").blur();
      if (!element("helptext").hidden) element("helptext").hidden = true;
      else viewer.select(-1);
    },
  };
}

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
