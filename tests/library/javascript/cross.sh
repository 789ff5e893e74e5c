# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2154  # jobs is dev's
# `./dev cross wasm`: the npm package and its tests, and the core's recorded orders, in Node.

build_wasm() {
  local build=build/cross-wasm part parts=()
  verb_setup library javascript
  for part in BENCH BULLET C CCD DEMOS FCL INSTALL MPI PYTHON_PACKAGE TBB TESTS; do parts+=("-DBOXSTREAM_$part=OFF"); done
  cmake -S . -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/cross/wasm.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_UNITY_BUILD=ON -DBOXSTREAM_WERROR=ON "${parts[@]}" >/dev/null || die "configuring $build failed"
  cmake --build "$build" --parallel "$jobs" >&2 || die "building for wasm failed"
}

# [--short] [OPTIONS OF ctest]; the short form is the whole.
cross_wasm() {
  [[ ${1:-} != --short ]] || shift
  build_wasm
  build_live
  ctest --test-dir build/cross-wasm --output-on-failure --no-tests=error --parallel "$jobs" "$@" >&2 || die "wasm: tests failed"
  say "wasm: pairs and orders are those of tests/library/core/golden_order.txt"
  say "the npm package: build/cross-wasm/adapters/javascript/boxstream"
}
