# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# For scripts that build the engine in ways of their own, for this machine and one SIMD target. They set root.

compile() { # object, source, directory of the engine's sources, more options
  # shellcheck disable=SC2154  # root is theirs
  "${CXX:-g++}" -std=c++20 -O3 -DNDEBUG -march=native -DHWY_COMPILE_ONLY_STATIC -ffp-contract=off -I"$root/include" -I"$3" \
    -I"$root/demos" -I"$root/bench" "${@:4}" -c "$2" -o "$1"
}

# All of the library that a Detector needs.
engine=()
for source in "$root"/src/search/*.cpp; do engine+=("$(basename "$source" .cpp)"); done

# The program that times batches, all but the engine.
compile_probe() { # directory of objects, more options
  local source
  mkdir -p "$1"
  for source in bench/engine_probe bench/measure bench/pair_hash demos/batches/{bars,batches,gathered,hard,paper} \
    demos/batches/{scattered,structured}; do
    compile "$1/$(basename "$source").o" "$root/$source.cpp" "$root/src" "${@:2}"
  done
}
