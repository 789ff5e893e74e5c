# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# `./dev live`: the live page, of the npm package and of packages that npm installs.

help_live() {
  cat <<'TEXT'
usage: ./dev live
Makes the live page, one file that needs neither server nor network: out/live.html. Builds the npm package for it, if it
is not there (2 minutes), and installs what package-lock.json of demos/pictures/viewer/web names. See docs/live.md.
TEXT
}

# Into build/cross-wasm/live: node_modules and live.html.
build_live() {
  local place=build/cross-wasm/live package=build/cross-wasm/adapters/javascript/boxstream web=demos/pictures/viewer/web
  [[ -e $package/index.mjs ]] || build_wasm
  mkdir -p "$place"
  if [[ ! $place/node_modules/.package-lock.json -nt $web/package-lock.json ]]; then
    cp "$web"/{package.json,package-lock.json,.npmrc} "$place"
    (cd "$place" && npm ci --prefer-offline --no-audit --no-fund) >&2 || die "npm could not install the packages of $web/package-lock.json"
  fi
  ln -sfn "$PWD/$package" "$place/node_modules/boxstream"
  node "$web/build.mjs" "$place" demos/live "$place/live.html" || die "the live page could not be made"
}

verb_live() {
  verb_setup javascript
  build_live
  mkdir -p out
  cp build/cross-wasm/live/live.html{,.licences} out
  printf "page: %s/out/live.html\n" "$PWD"
}
