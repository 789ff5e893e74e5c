# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2034
# For scripts that build the engine in their own ways, for this machine and one SIMD target.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

die() {
  printf '%s: %s\n' "$(basename "$0" .sh)" "$*" >&2
  exit 1
}

# From the environment: what timed programs are started with.
prefix=(env)
[[ -z ${PREFIX:-} ]] || read -ra prefix <<<"$PREFIX"

# Takes "--into PAGE.md" of a block's name, and sets page.
page=''
take_page() { # name, arguments
  [[ ${2:-} == --into ]] || return 0
  page=${3:?a page}
  grep -q "^<!-- $1: begin -->\$" "$page" || die "$page has no place for the block $1"
}

# Puts a file between the lines of the block in page, if there is one.
fill_page() { # name, file
  [[ -z $page ]] || sed -i -e "/^<!-- $1: begin -->\$/,/^<!-- $1: end -->\$/{//!d}" -e "/^<!-- $1: begin -->\$/r $2" "$page"
}

compile() { # object, source, directory of the engine's sources, more options
  "${CXX:-g++}" -std=c++20 -O3 -DNDEBUG -march=native -DHWY_COMPILE_ONLY_STATIC -ffp-contract=off -I"$root/include" -I"$3" \
    -I"$root/demos" -I"$root/bench" "${@:4}" -c "$2" -o "$1"
}

# All of the library that a Detector needs: files of src without their suffix. Old versions had one folder.
engine_of() {  # directory of sources
  local file
  for file in "$1"/{base,batch,search}/*.cpp; do
    [[ ! -e $file ]] || (file=${file#"$1"/} && echo "${file%.cpp}")
  done
}
mapfile -t engine < <(engine_of "$root/src")

# The program that times batches, all but the engine.
compile_probe() { # directory of objects, more options
  local source
  mkdir -p "$1"
  for source in bench/engine/probe bench/peers/pair_hash demos/measure/{interleave,stopwatch} \
    demos/inputs/{bars,batches,gathered,hard,paper,scattered,structured}; do
    compile "$1/$(basename "$source").o" "$root/$source.cpp" "$root/src" "${@:2}"
  done
}
