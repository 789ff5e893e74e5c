// SPDX-License-Identifier: MIT

const dark = globalThis.matchMedia?.("(prefers-color-scheme: dark)");

export const themeOf = (wish) => (wish === "auto" ? (dark.matches ? "dark" : "light") : wish);

export function applyTheme(wish) {
  document.documentElement.dataset.theme = themeOf(wish);
}

export const watchSystemTheme = (act) => dark.addEventListener("change", act);
