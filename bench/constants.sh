#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Sweeps the constants of the engine: builds it again with other values, one constant at a time, and times them interleaved.
# The sources are copied and the copies edited, so the engine itself has no switches.
set -euo pipefail
# shellcheck source=bench/engine/build.sh
. "$(dirname "${BASH_SOURCE[0]}")/engine/build.sh"

# file, name, values to try
table='
src/base/thresholds.hpp no_plan_below       80 160 192 320
src/base/thresholds.hpp leaf_tolerance      1.5 2.0 4.0
src/batch/cuts/plan.hpp  capacity               256 512 1024
src/batch/cuts/plan.cpp  resolution             1024 2048 4096
src/batch/cuts/cells.hpp most_cells             64 128 256 512
src/batch/records/load.hpp  load_block             16 32 64
src/batch/cuts/plan.cpp  classify_box           2.5 5.0 10.0
src/batch/cuts/plan.cpp  classify_more          1.0 2.0 4.0
src/batch/cuts/plan.cpp  emit_pair              1.6 3.3 6.6
src/batch/cuts/plan.cpp  scatter_copy           2.0 4.0 8.0
src/batch/cuts/plan.cpp  order_copy             4.0 8.0 16.0
src/base/thresholds.hpp compare_block       0.85 1.7 3.4
src/batch/cuts/plan.cpp  window_of_block        10.0 19.0 38.0
src/batch/cuts/plan.cpp  widest_of_block        1.0 1.4 2.0
src/base/thresholds.hpp make_leaf           150.0 300.0 600.0
src/base/thresholds.hpp boxes_in_cache      512 1024 2048
src/batch/cuts/plan.cpp  beyond_cache           0.05 0.1 0.2
src/base/thresholds.hpp one_level_below     4096 8192 16384
src/base/thresholds.hpp boxes_per_bucket    2 4 6 8
src/batch/leaf/sweep_kernel-inl.hpp eager                  1 2 3 4
src/base/thresholds.hpp longest_window      4 32
src/batch/leaf/sweep_kernel-inl.hpp block_position         12 24 48
src/batch/leaf/sweep_kernel-inl.hpp run_begin              60 120 240
'
cases=(U:1000 U:10000 U:100000 S:100000 M:100000 P:100000 X:100000 R:30000)
rounds=3

usage() {
  cat <<'TEXT'
usage: bench/constants.sh [--check | --into PAGE.md] [CONSTANT [VALUE...]]
Tries other values of one constant, or of all, and prints times relative to the value in the sources (1.00; below is
better), medians, the best of several interleaved runs. With --check: only checks that each constant of the table is in the sources.
With --into: also writes the best and worst of each constant between the lines '<!-- constants: begin -->' and
'<!-- constants: end -->' of a page.
In the environment: CASES="U:1000 M:100000" (on what), ROUNDS=5 (how often), PREFIX="taskset -c 1" (of what is timed).
Needs a compiler and Highway.
TEXT
}

# The value of a constant, which has to be defined once.
value_of() {
  local found
  found=$(perl -0ne "while (/(?:constexpr |^  )[\\w:]+ $2 =\\s*([^;]+);/mg) { print \"\$1\\n\" }" "$root/$1")
  [[ $(wc -l <<<"$found") == 1 && -n $found ]] || die "$1 does not define $2 once"
  printf '%s' "$found"
}

# Objects of the engine with $3 = $4 in $2, in directory $1; without $2 as it is.
build() {
  local dir=$1 unit units=("${engine[@]}")
  mkdir -p "$dir"
  cp -r "$root/src" "$dir"
  if [[ -n ${2:-} ]]; then
    perl -0pi -e "s/((?:constexpr |^  )[\\w:]+ $3 =\\s*)[^;]+;/\${1}$4;/m" "$dir/$2"
    [[ $2 == *.hpp ]] || units=("$(sed 's|^src/||; s|\.cpp$||' <<<"$2")")
    cp "$out"/base/*.o "$dir"
  fi
  for unit in "${units[@]}"; do compile "$dir/$(basename "$unit").o" "$dir/src/$unit.cpp" "$dir/src"; done
  "${CXX:-g++}" "$dir"/*.o "$out"/probe/*.o -lhwy -o "$dir/probe"
}

sweep() { # file, name, values
  local file=$1 name=$2 now value dirs=() labels=()
  now=$(value_of "$file" "$name")
  now=${now// /}
  shift 2
  for value in "$@"; do
    [[ $value != "$now" ]] || continue
    build "$out/$name-$value" "$file" "$name" "$value"
    dirs+=("$out/$name-$value")
    labels+=("$value")
  done
  local round i
  for ((round = 0; round < ${ROUNDS:-$rounds}; ++round)); do
    "${prefix[@]}" "$out/base/probe" "${cases[@]}" | sed "s/^/$now,now /"
    for i in "${!dirs[@]}"; do "${prefix[@]}" "${dirs[$i]}/probe" "${cases[@]}" | sed "s/^/${labels[$i]} /"; done
  done | awk -v name="$name" -v file="$file" -v columns="${cases[*]}" -v markdown="$out/markdown" '
    { key = $1 SUBSEP $2; if (!(key in best) || $3 < best[key]) best[key] = $3 + 0
      if (!($1 in seen)) { seen[$1] = 1; order[++count] = $1 }
      if (!($2 in hash)) hash[$2] = $4; else if (hash[$2] != $4) wrong = 1 }
    END { split(columns, column, " "); printf "\n%-32s", name
          for (c = 1; c in column; ++c) printf " %9s", column[c]
          print ""
          for (i = 1; i <= count; ++i) { printf "%-32s", "  " order[i]
            if (i > 1) values = values (i > 2 ? ", " : "") order[i]
            for (c = 1; c in column; ++c) {
              ratio = best[order[i] SUBSEP column[c]] / best[order[1] SUBSEP column[c]]
              printf " %9.3f", ratio
              where = sprintf("%.2f (%s, %s)", ratio, order[i], column[c])
              if (i > 1 && (low == "" || ratio < low)) { low = ratio; low_where = where }
              if (i > 1 && (high == "" || ratio > high)) { high = ratio; high_where = where } }
            print "" }
          sub(/,now/, "", order[1])
          printf "| `%s` | `%s` | %s | %s | %s | %s |\n", name, file, order[1], values, low_where, high_where >> markdown
          if (wrong) { print "FAIL: pairs differ"; exit 1 } }'
  local dir
  for dir in "${dirs[@]}"; do rm -rf "$dir"; done
}

check_only=''
take_page constants "$@"
case "${1:-}" in
  --help | -h) usage && exit ;;
  --check) check_only=1 && shift ;;
  --into) shift 2 ;;
esac
[[ -z ${CASES:-} ]] || read -ra cases <<<"$CASES"

wanted=$(sed '/^$/d' <<<"$table")
if (($# > 0)); then
  wanted=$(awk -v name="$1" '$2 == name' <<<"$wanted")
  [[ -n $wanted ]] || die "no constant $1 in the table"
  if (($# > 1)); then wanted="$(awk '{ print $1, $2 }' <<<"$wanted") ${*:2}"; fi
fi

if [[ -n $check_only ]]; then
  while read -r file name _; do
    value=$(value_of "$file" "$name")  # apart, for within an argument its failure would go unnoticed
    printf '%s %s = %s\n' "$file" "$name" "$value"
  done <<<"$wanted"
  exit
fi

out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
compile_probe "$out/probe"
build "$out/base"
while read -r file name values; do
  # shellcheck disable=SC2086  # several values
  sweep "$file" "$name" $values </dev/null
done <<<"$wanted"
if [[ -n $page ]]; then
  {
    printf '| constant | in | value | others tried | best | worst |\n|---|---|--:|---|---|---|\n'
    cat "$out/markdown"
  } >"$out/table"
  fill_page constants "$out/table"
fi
