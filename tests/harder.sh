# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2154  # jobs is dev's
# Verbs of ./dev that try library and tests harder than ./dev test does. Sourced by dev.

help_harder() {
  case "$1" in
    fuzz) cat <<'TEXT' ;;
usage: ./dev fuzz [--seed N] [--record] [SECONDS [TARGET...]]
       ./dev fuzz merge [TARGET...]
Sets up, builds the fuzzers (clang, preset asan-ubsan) and runs each of them for SECONDS (60), two at a time, all or
those named. Prints a line for each; fails if one crashed, and says how to repeat that. What they find is in out/fuzz.
  --seed  the inputs that this number leads to; without it others in each run. ./dev test --whole takes the commit's number,
          so a commit that passed once passes again
  --record  add the runs to tests/fuzz/runs.tsv, by processor time, and make the table of docs/internals/fuzzing.md anew
  merge  take into tests/fuzz/corpus/TARGET.tar what new inputs reach that the corpus does not
docs/internals/fuzzing.md says what each target takes.
TEXT
    soak) cat <<'TEXT' ;;
usage: ./dev soak [--minutes 10] [--memory-mb 1024] [--seed 1] [--load NAME]...
Builds and runs boxstream_soak: batches, worlds, Bullet scenes and FCL scenes in turn, every answer compared with an
oracle's. A wrong answer ends it with the command that repeats it; so does memory that grows.
TEXT
    determinism) cat <<'TEXT' ;;
usage: ./dev determinism [COMPILER-LEVEL...]
Builds the core six times, {g++, clang++} x {O0, O2, O3}, and runs the tests that compare the order of pairs with the
recorded one on every SIMD target, with 1 to 4 threads and shuffled executors. A difference ends in the first line of
tests/library/core/golden_order.txt that differs. Without arguments all six; else for example: ./dev determinism clang++-O0
TEXT
    mutants) cat <<'TEXT' ;;
usage: ./dev mutants [--handful] [--search] [--list] [--jobs N] [NAME...]
Builds a copy of core, adapters and their tests that has the faults of tests/mutants/faults.json in it, in
build/mutants, and switches these on one by one: the tests that a fault names must fail with it, and pass without any.
  NAME       only these faults
  --handful  a few, others for each commit, as ./dev test --whole does
  --search   says for each fault which tests notice it: for adding one
  --list     prints the faults and does nothing
TEXT
    meshes) cat <<'TEXT' ;;
usage: ./dev meshes [FILE...]
Builds boxstream_cgal_witness and compares, pair for pair, which triangles intersect with what CGAL finds, in doubles:
of the meshes in the Debian packages of tests/lab/cgal/packages.txt, which are downloaded to build/meshes and not installed,
or of the files named. A line a file is in build/meshes/table.txt; those that differ are printed, and fail.
TEXT
    coverage) cat <<'TEXT' ;;
usage: ./dev coverage [--fuzz] [--into PAGE.md] [--programs REGEX]
Builds preset coverage, with clang, runs the tests of core and adapters, and prints what they reach of each file. Each
line that is never reached must have its reason in tests/coverage/reasons.json, and 95 % of all branches must be
reached. What is not: build/coverage/uncovered.txt.
  --fuzz      plays the corpora of the fuzzers instead, and prints what these alone reach of src/batch, box_index, bvh, nearest and
              world, of which it should be 95 % of the lines
  --into      replaces the table in tests/coverage/coverage.md, or another page; with --fuzz the second one there
  --programs  runs only the test programs that match
TEXT
  esac
}

# Meshes of Debian's packages below build/meshes/files, as files that are no archives.
unpack_meshes() {
  local packages=build/meshes/packages package
  mkdir -p "$packages" build/meshes/files
  while read -r package; do
    [[ ! -d build/meshes/files/$package ]] || continue
    compgen -G "$packages/${package}_*.deb" >/dev/null || (cd "$packages" && apt-get -qq download "$package") ||
      die "package $package could not be downloaded: connect to the network and repeat"
    rm -rf build/meshes/new
    dpkg-deb -x "$packages/${package}"_*.deb build/meshes/new
    find build/meshes/new -type f -regextype posix-extended -iregex '.*\.(obj|off|ply|stl)\.gz' -exec gunzip {} +
    find build/meshes/new -type f -regextype posix-extended -not -iregex '.*\.(obj|off|ply|stl)' -delete
    mv build/meshes/new "build/meshes/files/$package"
  done < <(grep -v '^#' tests/lab/cgal/packages.txt)
}

verb_meshes() {
  verb_setup
  build_preset release boxstream_cgal_witness >&2
  local witness=build/release/tests/lab/cgal/boxstream_cgal_witness table=build/meshes/table.txt files=("$@") file
  mkdir -p build/meshes
  if ((!$#)); then
    unpack_meshes
    mapfile -t files < <(find build/meshes/files -type f | LC_ALL=C sort)
  fi
  for file in "${files[@]}"; do
    timeout 300 "$witness" "$file" || (($? == 1)) || printf 'DIFFERENT  %s: the witness did not end\n' "$file"
  done >"$table"
  grep '^DIFFERENT' "$table" || true
  printf '%s meshes: %s equal, %s refused, %s read otherwise by CGAL, %s different: %s\n' "${#files[@]}" \
    "$(grep -c '^equal' "$table")" "$(grep -c '^refused' "$table")" "$(grep -c '; CGAL' "$table")" \
    "$(grep -c '^DIFFERENT' "$table")" "$table"
  ! grep -q '^DIFFERENT' "$table"
}

# Those that search are there twice, with small thresholds as TARGET_small; the corpus is one.
fuzz_targets() {
  grep -l 'int LLVMFuzzerTestOneInput' tests/fuzz/*.cpp | sed 's|.*/||; s|\.cpp$||'
  printf '%s_small\n' bullet core fcl index rules world
}

# The corpus as files: out/fuzz/seeds/NAME.
unpack_corpus() {
  local archive seeds
  for archive in tests/fuzz/corpus/*.tar; do
    seeds=out/fuzz/seeds/$(basename "$archive" .tar)
    rm -rf "$seeds"
    mkdir -p "$seeds"
    tar -xf "$archive" -C "$seeds"
  done
}

# The same bytes for the same files.
pack_corpus() {
  tar --sort=name --format=ustar --owner=0 --group=0 --numeric-owner --mode=0644 --mtime=@0 \
    --transform='s|^\./||' -cf "tests/fuzz/corpus/$1.tar" -C "out/fuzz/seeds/$1" --no-recursion \
    --verbatim-files-from -T <(cd "out/fuzz/seeds/$1" && LC_ALL=C ls)
}

fuzzer() { printf 'build/asan-ubsan/tests/fuzz/boxstream_fuzzer_%s' "$1"; }

# Prints a line, keeps the log, and makes the first crash smaller as far as that is quick. Adds what it did to the list
# that is named, if any.
fuzz_one() {
  local target=$1 seconds=$2 seed=$3 runs=$4 out=out/fuzz/$1 corpus=${1%_small} status=0 crash options
  local dictionary=tests/fuzz/$corpus.dict
  local TIMEFORMAT='%0U %0S' user system
  options=(-seed="$seed" -timeout=30 -rss_limit_mb=3000 -malloc_limit_mb=1000 -max_len=4096 -len_control=0)
  [[ ! -f $dictionary ]] || options+=(-dict="$dictionary")
  mkdir -p "$out/corpus"
  # As a list, because the order of a folder's files is the file system's.
  find "out/fuzz/seeds/$corpus" -type f | sort | paste -sd, >"$out/seeds"
  { time "$(fuzzer "$target")" "$out/corpus" -seed_inputs=@"$out/seeds" "${options[@]}" -max_total_time="$seconds" \
    -print_final_stats=1 -artifact_prefix="$out/" >"$out/log" 2>&1 || status=$?; } 2>"$out/time"
  crash=$(sed -n "s/.*Test unit written to //p" "$out/log" | tail -1)
  # 70 is a timeout, by the clock: a fuzzer that others keep from the processor takes an input for slow that is not.
  if [[ $status == 70 ]] && "$(fuzzer "$target")" -timeout=30 "$crash" >"$out/again.log" 2>&1; then status=0; fi
  stat() { sed -n "s/^stat::$1: *//p" "$out/log"; }
  printf '%-14s %10s executions, %5s new inputs, %s\n' "$target" "$(stat number_of_executed_units)" \
    "$(stat new_units_added)" "$([[ $status == 0 ]] && echo "no crash" || echo "CRASHED, log: $out/log")"
  if [[ $runs ]]; then
    # A busy machine gives a fuzzer less than the seconds it runs.
    read -r user system <"$out/time"
    printf '%s\t%s\t%s\t%s\t%s\n' "$(date -u +%F)" "$target" $((user + system)) "$(stat number_of_executed_units)" \
      "$status" >>"$runs"
  fi
  [[ $status != 0 ]] || return 0
  if [[ -f $crash ]]; then
    "$(fuzzer "$target")" -minimize_crash=1 -max_total_time=20 -timeout=30 -exact_artifact_path="$out/smallest" \
      "$crash" >"$out/minimize.log" 2>&1 || true
    [[ ! -f $out/smallest ]] || crash=$out/smallest
    say "repeat: $(fuzzer "$target") $crash"
    # Elsewhere, from a log alone: the input itself, and what it did.
    say "input:  base64 -d <<<'$(base64 -w0 "$crash")'"
    grep -hm1 -A4 -E "ERROR:|does not hold" "$out/log" | cut -c1-160 || true
  fi
  touch "$out/crashed"
}

# Without counters, for an input that only runs known code more often is no test of its own. What either of two targets
# of one corpus found may be new to the other.
merge_into_corpus() {
  local target=$1 corpus=${1%_small} found=() folder
  for folder in "out/fuzz/$corpus/corpus" "out/fuzz/${corpus}_small/corpus"; do
    [[ ! -d $folder ]] || found+=("$folder")
  done
  "$(fuzzer "$target")" -merge=1 -use_counters=0 -timeout=30 -artifact_prefix="out/fuzz/$target/" \
    "out/fuzz/seeds/$corpus" "${found[@]}" >"out/fuzz/$target/merge.log" 2>&1 ||
    die "merging failed: out/fuzz/$target/merge.log"
  pack_corpus "$corpus"
}

verb_fuzz() {
  local seconds=60 seed=0 merge="" runs="" target targets=()
  while [[ ${1:-} == --* ]]; do
    case "$1" in
      --seed)
        seed=${2:-}
        [[ $seed =~ ^[0-9]+$ ]] || die "--seed takes a number"
        shift
        ;;
      --record) runs=tests/fuzz/runs.tsv ;;
      *) die "unknown option $1; see ./dev help fuzz" ;;
    esac
    shift
  done
  if [[ ${1:-} == merge ]]; then
    merge=1
    shift
  elif [[ ${1:-} =~ ^[0-9]+$ ]]; then
    seconds=$1
    shift
  fi
  mapfile -t targets < <(fuzz_targets)
  local all=" ${targets[*]} "
  if (($#)); then targets=("$@"); fi
  for target in "${targets[@]}"; do
    [[ $all == *" $target "* ]] || die "no target $target; there are:$all"
  done
  verb_setup
  build_preset asan-ubsan boxstream_fuzzers >&2
  rm -f out/fuzz/*/crashed
  local -x LSAN_OPTIONS=suppressions=$PWD/tests/fuzz/lsan.supp:print_suppressions=0
  unpack_corpus
  for target in "${targets[@]}"; do
    mkdir -p "out/fuzz/$target/corpus"
    if [[ $merge ]]; then
      merge_into_corpus "$target"
      continue
    fi
    while (($(jobs -rp | wc -l) >= 2)); do wait -n || true; done
    fuzz_one "$target" "$seconds" "$seed" "$runs" &
  done
  wait
  [[ ! $runs ]] || python3 tests/fuzz/table.py --into docs/internals/fuzzing.md
  [[ -z $(find out/fuzz -name crashed) ]] || die "fuzzers crashed, see above"
}

verb_soak() {
  verb_setup
  build_preset release boxstream_soak >&2
  build/release/tests/lab/soak/boxstream_soak "$@"
}

verb_determinism() {
  local all=(g++-O0 g++-O2 g++-O3 clang++-O0 clang++-O2 clang++-O3) failed=() build dir
  (($#)) || set -- "${all[@]}"
  for build in "$@"; do
    [[ " ${all[*]} " == *" $build "* ]] || die "no build $build; there are: ${all[*]}"
  done
  verb_setup
  for build in "$@"; do
    dir=build/determinism/$build
    mkdir -p "$dir"
    say "== determinism, $build"
    # A build type of its own, so that no flags but these are used.
    cmake -S . -B "$dir" -G Ninja -DCMAKE_CXX_COMPILER="${build%-*}" -DCMAKE_BUILD_TYPE=Plain \
      -DCMAKE_CXX_FLAGS_PLAIN="-${build##*-}" -DBOXSTREAM_DEMOS=OFF -DBOXSTREAM_BENCH=OFF -DBOXSTREAM_INSTALL=OFF \
      >"$dir/configure.log" 2>&1 || { cat "$dir/configure.log" >&2 && die "configuring $build failed"; }
    cmake --build "$dir" --parallel "$jobs" --target boxstream_golden_tests >&2 || die "building $build failed"
    ctest --test-dir "$dir" --parallel "$jobs" --output-on-failure --no-tests=error -R Golden || failed+=("$build")
  done
  ((${#failed[@]} == 0)) || die "another order than the recorded one in: ${failed[*]}"
}

verb_mutants() {
  verb_setup
  tests/mutants/mutants.py --jobs "$jobs" "$@"
}

verb_coverage() {
  verb_setup
  local targets=(boxstream_coverage_tests)
  [[ " $* " != *" --fuzz "* ]] || targets=(boxstream_fuzz_{core,fcl,index,rules,world}{,_small})
  build_preset coverage "${targets[@]}" >&2
  tests/coverage/coverage.py build/coverage "$@"
}
