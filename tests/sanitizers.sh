# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2154  # jobs and tests_failed are dev's
# Ways to look for undefined behaviour that ./dev test has no time for. Sourced by dev.

sanitizer_rows=(gcc memory stl valgrind)

help_sanitizers() {
  cat <<'TEXT'
usage: ./dev sanitizers [ROW...]
Looks for undefined behaviour in ways that ./dev test has no time for, in all or those named:
  gcc       the suite under GCC's address and undefined behaviour sanitizers
  memory    the core under clang's memory sanitizer: the recorded orders, and its fuzzer for a minute
  stl       the core with the checks of libstdc++'s containers: the recorded orders, the corpora of core and World
  valgrind  the tests of the adapters under valgrind's memcheck: Debian's Bullet and FCL have no sanitizer in them
TEXT
}

# sanitizer_build ROW TARGETS OPTIONS...: TARGETS is one word, and there are no programs but tests.
sanitizer_build() {
  local dir=build/sanitizers/$1 targets
  read -ra targets <<<"$2"
  shift 2
  mkdir -p "$dir"
  cmake -S . -B "$dir" -G Ninja -DBOXSTREAM_WERROR=ON -DBOXSTREAM_DEMOS=OFF -DBOXSTREAM_BENCH=OFF \
    -DBOXSTREAM_INSTALL=OFF "$@" >"$dir/configure.log" 2>&1 || { cat "$dir/configure.log" >&2 && die "configuring $dir failed"; }
  cmake --build "$dir" --parallel "$jobs" --target "${targets[@]}" >&2 || die "building $dir failed"
}

# The program that prints the orders has no test library in it, which neither checks come to terms with.
recorded_orders() { "build/sanitizers/$1/tests/core/boxstream_golden_order" | diff - tests/core/golden_order.txt; }

sanitizer_gcc() { test_preset asan-ubsan-gcc && ((${#tests_failed[@]} == 0)); }

sanitizer_memory() {
  local fuzzer=build/sanitizers/memory/tests/fuzz/boxstream_fuzzer_core corpus=out/sanitizers/memory
  sanitizer_build memory "boxstream_golden_order boxstream_fuzzer_core" -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" -DBOXSTREAM_SANITIZE=memory \
    -DBOXSTREAM_FUZZ=ON
  mkdir -p "$corpus"
  recorded_orders memory || return 1
  "$fuzzer" "$corpus" tests/fuzz/corpus/core -max_total_time=60 -max_len=4096 -timeout=60 -artifact_prefix="$corpus-" \
    >"$corpus.log" 2>&1 || { tail -40 "$corpus.log" >&2 && return 1; }
}

sanitizer_stl() {
  sanitizer_build stl "boxstream_golden_order boxstream_fuzz_core boxstream_fuzz_world" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1 -D_GLIBCXX_DEBUG -D_GLIBCXX_ASSERTIONS"
  recorded_orders stl || return 1
  local target
  for target in core world; do
    "build/sanitizers/stl/tests/fuzz/boxstream_fuzz_$target" "tests/fuzz/corpus/$target" >/dev/null || return 1
  done
}

sanitizer_valgrind() {
  local program
  sanitizer_build valgrind "bullet_tests fcl_tests boxstream_ccd_tests" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1 -DBOXSTREAM_TESTS_DO_LESS"
  for program in bullet/bullet_tests fcl/fcl_tests ccd/boxstream_ccd_tests; do
    say "valgrind: $program"
    RC_PARAMS=max_success=3 valgrind --quiet --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite \
      "build/sanitizers/valgrind/tests/$program" --gtest_brief=1 || return 1
  done
}

verb_sanitizers() {
  local row failed=()
  (($#)) || set -- "${sanitizer_rows[@]}"
  for row in "$@"; do
    [[ " ${sanitizer_rows[*]} " == *" $row "* ]] || die "no row $row; there are: ${sanitizer_rows[*]}"
  done
  verb_setup
  for row in "$@"; do
    say "== sanitizers, $row"
    if "sanitizer_$row"; then printf '%-10s passed\n' "$row"; else failed+=("$row") && printf '%-10s FAILED\n' "$row"; fi
  done
  ((${#failed[@]} == 0)) || die "found something in: ${failed[*]}"
}
