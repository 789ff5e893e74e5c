#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Where a search spends its time, phase by phase.
set -euo pipefail
# shellcheck source=bench/engine/build.sh
. "$(dirname "${BASH_SOURCE[0]}")/engine/build.sh"

usage() {
  cat <<'TEXT'
usage: bench/profile.sh [--into PAGE.md] [NAME:N...]
Nanoseconds per box of each phase of find_pairs, from samples of the innermost inlined function of the engine; then
instructions, loads and stores, and L1 misses
per box, as Valgrind counts them, for the first case. With --into: also writes both tables between the lines
'<!-- profile: begin -->' and '<!-- profile: end -->' of a page.
In the environment: PREFIX="taskset -c 1" (of what is timed).
Needs a compiler, Highway, binutils, perf (Debian: linux-perf) and valgrind.
TEXT
}

take_page profile "$@"
case "${1:-}" in
  --help | -h) usage && exit ;;
  --into) shift 2 ;;
esac
cases=("$@")
((${#cases[@]} > 0)) || cases=(U:100000 U:1000 U:10000 U:1000000 S:100000 P:100000 W2:100000 D:100000 M:100000 R:100000)
for tool in perf valgrind addr2line; do command -v $tool >/dev/null || die "no $tool here"; done

out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# With fixed addresses, so that samples can be looked up without a map of the process.
build() { # program, more options
  local dir="$1.objects" unit
  compile_probe "$dir" -g -fno-pie "${@:2}"
  for unit in "${engine[@]}"; do compile "$dir/$(basename "$unit").o" "$root/src/$unit.cpp" "$root/src" -g -fno-pie "${@:2}"; done
  "${CXX:-g++}" -no-pie "$dir"/*.o -lhwy -o "$1"
}

# A phase, and the functions that it begins with. Whatever they call or inline belongs to them, unless it has a line.
phases='plan|make_plan\(|Sample::|draw_sample|choose_
load|LoadRecords
locate|Locate\(|find_slabs|slabs_of
count|Partition::count
scatter|Partition::scatter|CopyToCells
order|extract\(|LaneExtents|count_buckets\(|order_by_|find_buckets
pack|pack\(|pack_both
columns|make_columns\(
sweep: begin a block|sweep_block\(
sweep: weigh far-reaching boxes|sweep_far\(
sweep: positions|find_in_
second look|emit_sparse|emit_dense|part_by_density|put<|compare_all
hand over|flush\(|::take\('

# From lines "address weight" to lines "phase|weight"; what is not of the engine is left out.
by_phase() { # program
  sort | awk '{ sum[$1] += $2 } END { for (a in sum) print a, sum[a] }' | sort >"$out/weights"
  cut -d' ' -f1 "$out/weights" | addr2line -e "$1" -a -i -f -C 2>/dev/null |
    awk -v phases="$phases" -v weights="$out/weights" '
      BEGIN { count = split(phases, line, "\n")
              for (i = 1; i <= count; ++i) { name[i] = line[i]; sub(/\|.*/, "", name[i])
                                             pattern[i] = substr(line[i], length(name[i]) + 2) }
              while ((getline < weights) > 0) { ++places; weight[places] = $2 } }
      function finish() { if (place == 0 || !ours) return
                          print (found == "" ? "other" : found) "|" weight[place] }
      /^0x[0-9a-f]+$/ { finish(); ++place; found = ""; ours = 0; odd = 0; next }
      { odd = !odd; if (!odd) next
        if ($0 ~ /boxstream::batches|boxstream::bench/) { next }
        if ($0 ~ /boxstream::/) ours = 1
        for (i = 1; found == "" && i <= count; ++i) if ($0 ~ pattern[i]) found = name[i] }
      END { finish() }' |
    awk -F'|' '{ sum[$1] += $2 } END { for (p in sum) print p "|" sum[p] }'
}

names() { cut -d'|' -f1 <<<"$phases" && echo other; }

# From lines "column|phase|value" to a table of the columns named.
table() { # file, heading, columns
  local file=$1 heading=$2 column p
  shift 2
  printf '\n| %s |' "$heading"
  printf ' %s |' "$@"
  printf '\n|---|'
  printf -- '--:|%.0s' "$@"
  printf '\n'
  { names && echo all; } | while read -r p; do
    printf '| %s |' "$p"
    for column in "$@"; do
      awk -F'|' -v c="$column" -v p="$p" '$1 == c && $2 == p && $3 >= 0.05 { v = sprintf(" %.1f", $3) }
        END { printf "%s |", v }' "$file"
    done
    printf '\n'
  done
}

# Times: the least of twenty rounds, shared out by samples of all of them.
build "$out/run"
for c in "${cases[@]}"; do
  printf 'profile: %s\n' "$c" >&2
  rounds=()
  while ((${#rounds[@]} < 20)); do rounds+=("$c"); done
  "${prefix[@]}" perf record -q -F 10000 -e cpu-clock:u -o "$out/samples" "$out/run" "${rounds[@]}" >"$out/times"
  ns=$(awk -v n="${c#*:}" '!best || $2 < best { best = $2 } END { print 1e6 * best / n }' "$out/times")
  perf script -i "$out/samples" -F ip 2>/dev/null | awk '{ print "0x" $1, 1 }' | by_phase "$out/run" |
    awk -F'|' -v c="$c" -v ns="$ns" '{ w[$1] = $2; all += $2 }
      END { for (p in w) print c "|" p "|" ns * w[p] / all; print c "|all|" ns }'
done >"$out/ns"

# Counts: what three searches take more than one. Valgrind knows no AVX-512.
first=${cases[0]}
printf 'profile: %s, counting\n' "$first" >&2
build "$out/counted" -march=x86-64-v3 -maes -mpclmul  # without these two, Highway takes SSSE3
for times in 1 3; do
  valgrind --log-file="$out/valgrind.log" --tool=callgrind --cache-sim=yes --dump-instr=yes --compress-strings=no --compress-pos=no \
    --callgrind-out-file="$out/callgrind.$times" "$out/counted" "$first:$times" >/dev/null
  # Ir Dr Dw I1mr D1mr D1mw ...; the line after one of calls is what the callee took.
  awk '/^calls=/ { skip = 1; next } skip { skip = 0; next }
       /^0x/ { print $1, $3 > out ".1"; print $1, $4 + $5 > out ".2"; print $1, $7 + $8 > out ".3" }' \
    out="$out/counts.$times" "$out/callgrind.$times"
  for event in 1 2 3; do by_phase "$out/counted" <"$out/counts.$times.$event" | sed "s/^/$event|$times|/"; done
done | awk -F'|' -v n="${first#*:}" '
  { sign = $2 == 3 ? 0.5 : -0.5; v[$1 "|" $3] += sign * $4 / n; v[$1 "|all"] += sign * $4 / n }
  END { for (k in v) print k "|" v[k] }' |
  sed -e 's/^1|/instructions|/' -e 's/^2|/loads and stores|/' -e 's/^3|/L1 misses|/' >"$out/counts"

{
  table "$out/ns" 'ns a box' "${cases[@]}"
  table "$out/counts" "$first, per box" instructions 'loads and stores' 'L1 misses'
} | tee "$out/tables"
fill_page profile "$out/tables"
