# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# `./dev bench javascript`: the npm package beside its peers, which npm installs into a copy of this folder. Inputs and
# how peers are called are those of the live page.

bench_javascript() {
  local place=build/bench-javascript package=build/cross-wasm/adapters/javascript/boxstream
  build_wasm
  mkdir -p "$place"
  cp -r bench/javascript/. "$place"
  cp -rT demos/live/src "$place/live"
  (cd "$place" && npm ci --no-audit --no-fund) >&2 || die "npm could not install the peers of bench/javascript/package.json"
  ln -sfn "$PWD/$package" "$place/node_modules/boxstream"
  esbuild "$place/page.js" --bundle --format=esm --define:global=globalThis --log-level=warning --outfile="$place/bundle.js" ||
    die "the page of the benchmark could not be made"
  node "$place/bench.mjs" --page "$place/bundle.js" "$@"
}
