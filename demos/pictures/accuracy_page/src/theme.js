// SPDX-License-Identifier: MIT
// Light or dark: as the browser prefers, until somebody says otherwise.
import { setGround } from "./colours.js";
import { element } from "./dom.js";

const prefersDark = matchMedia("(prefers-color-scheme: dark)");
let chosen = null; // "light", "dark" or neither
const followers = new Set();

export const isDark = () => (chosen ? chosen === "dark" : prefersDark.matches);

/** Calls back whenever it gets light or dark. */
export const onTheme = (follow) => followers.add(follow);

function apply() {
  document.documentElement.classList.toggle("dark", isDark());
  setGround(isDark());
  for (const follow of followers) follow();
}

export function themeButton() {
  const button = element("button.theme", { type: "button", title: "Light or dark", onclick: () => ((chosen = isDark() ? "light" : "dark"), apply()) });
  const name = () => (button.textContent = isDark() ? "Light" : "Dark");
  onTheme(name);
  name();
  return button;
}

prefersDark.addEventListener("change", apply);
apply();
