# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2154  # jobs is dev's
# Ways to look for undefined behaviour that ./dev test has no time for. Sourced by dev.

sanitizer_rows=(gcc memory stl valgrind)

help_sanitizers() {
  cat <<'TEXT'
usage: ./dev sanitizers [ROW...]
Looks for undefined behaviour in ways that ./dev test has no time for, in all or those named:
  gcc       the tests of core and adapters under GCC's address and undefined behaviour sanitizers
  memory    the core under clang's memory sanitizer: the recorded orders, the corpus of its fuzzer
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

# By a program without a test library, which neither kind of check comes to terms with.
recorded_orders() { "build/sanitizers/$1/tests/library/core/boxstream_golden_order" | diff - tests/library/core/golden_order.txt; }

corpus_of() {
  "build/sanitizers/$1/tests/fuzz/boxstream_fuzz_$2" "tests/fuzz/corpus/$2.tar" >"build/sanitizers/$1/$2.log" 2>&1 ||
    { tail -30 "build/sanitizers/$1/$2.log" >&2 && return 1; }
}

sanitizer_gcc() {
  sanitizer_build gcc "boxstream_coverage_tests boxstream_batches_test" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" -DBOXSTREAM_SANITIZE="address,undefined"
  with_sane_layout ctest --test-dir build/sanitizers/gcc --parallel "$jobs" --output-on-failure --no-tests=error \
    -L '^(core|world|bullet|bullet_float64|ccd|fcl)$'
}

# With all templates of the standard library instantiated here, where the sanitizer sees what they write.
sanitizer_memory() {
  sanitizer_build memory "boxstream_golden_order boxstream_fuzz_core" -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_BUILD_TYPE=RelWithDebInfo -DBOXSTREAM_SANITIZE=memory \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1 -D_GLIBCXX_EXTERN_TEMPLATE=0"
  recorded_orders memory && corpus_of memory core
}

sanitizer_stl() {
  sanitizer_build stl "boxstream_golden_order boxstream_fuzz_core boxstream_fuzz_world" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1 -D_GLIBCXX_DEBUG -D_GLIBCXX_ASSERTIONS"
  recorded_orders stl && corpus_of stl core && corpus_of stl world
}

sanitizer_valgrind() {
  local program
  sanitizer_build valgrind "bullet_tests fcl_tests boxstream_ccd_tests" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1 -DBOXSTREAM_TESTS_DO_LESS"
  for program in bullet/bullet_tests fcl/fcl_tests ccd/boxstream_ccd_tests; do
    say "valgrind: $program"
    RC_PARAMS=max_success=3 valgrind --quiet --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite \
      "build/sanitizers/valgrind/tests/library/$program" --gtest_brief=1 || return 1
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
