// SPDX-License-Identifier: MIT
import { linkTo } from "./address.js";
import { element } from "./dom.js";

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
