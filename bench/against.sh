#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The engine as it is against that of another revision, on the same batches.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: bench/against.sh REVISION [NAME:N...]
Builds the engine of a revision and that of the sources in the same way, times both interleaved, and prints the best times of
a search in milliseconds and how many times as fast the sources are. Pairs have to be equal.
In the environment: ROUNDS=3 (how often), PREFIX="taskset -c 1" (of what is timed). Needs git, a compiler and Highway.
TEXT
}

# shellcheck source=bench/engine/build.sh
. "$(dirname "${BASH_SOURCE[0]}")/engine/build.sh"
case "${1:-}" in
  --help | -h) usage && exit ;;
  '') usage >&2 && exit 2 ;;
esac
revision=$1
shift
cases=("$@")
((${#cases[@]} > 0)) || cases=({U,S,C,D}:{1000,10000,100000} {lattice,heap,rods,scaffold}:100000)
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
compile_probe "$out/probe"
mkdir "$out/before" "$out/now"
git -C "$root" archive "$revision" src | tar -x -C "$out/before"
cp -r "$root/src" "$out/now"
for engine in before now; do
  for unit in $(engine_of "$out/$engine/src"); do
    compile "$out/$engine/$(basename "$unit").o" "$out/$engine/src/$unit.cpp" "$out/$engine/src"
  done
  "${CXX:-g++}" "$out/$engine"/*.o "$out"/probe/*.o -lhwy -o "$out/$engine/probe"
done

for ((round = 0; round < ${ROUNDS:-3}; ++round)); do
  for engine in before now; do "${prefix[@]}" "$out/$engine/probe" "${cases[@]}" | sed "s/^/$engine /"; done
done | awk '
  { key = $1 SUBSEP $2; if (!(key in best) || $3 < best[key]) best[key] = $3 + 0
    if (!($2 in hash)) { hash[$2] = $4; order[++count] = $2 } else if (hash[$2] != $4) wrong = 1 }
  END { printf "%-18s %10s %10s %8s\n", "batch", "before", "now", "ratio"
        for (i = 1; i <= count; ++i) { b = best["before" SUBSEP order[i]]; n = best["now" SUBSEP order[i]]
          printf "%-18s %10.3f %10.3f %8.2f\n", order[i], b, n, b / n }
        if (wrong) { print "FAIL: pairs differ"; exit 1 } }'
