# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2154  # jobs is dev's
# `./dev cross wasm`: the npm package and its tests, and the core's recorded orders, in Node.

cross_wasm() {
  local build=build/cross-wasm part parts=()
  verb_setup library javascript
  for part in BENCH BULLET C CCD DEMOS FCL INSTALL PYTHON_PACKAGE TBB TESTS; do parts+=("-DBOXSTREAM_$part=OFF"); done
  cmake -S . -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/cross/wasm.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DBOXSTREAM_WERROR=ON "${parts[@]}" >/dev/null || die "configuring $build failed"
  cmake --build "$build" --parallel "$jobs" || die "building for wasm failed"
  ctest --test-dir "$build" --output-on-failure || die "wasm: tests failed"
  say "wasm: pairs and orders are those of tests/core/golden_order.txt; the npm package is $build/adapters/javascript/boxstream"
}
