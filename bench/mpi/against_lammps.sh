#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Neighbours of N particles by boxstream::mpi and by LAMMPS (Debian: lammps), on 1, 2 and 4 ranks: against_lammps.sh PROGRAM [N]
# PROGRAM is boxstream_mpi_neighbours. Prints pairs, and milliseconds for a search: of boxstream, processor time outside MPI
# of the slowest rank; of LAMMPS, its time for lists, which on several ranks has waiting in it. Fails if pairs differ.
set -euo pipefail
program=${1:?which boxstream_mpi_neighbours?} n=${2:-200000}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" "$n" "$folder/particles"
# Nothing moves, and lists are made anew in each of 20 steps.
cat >"$folder/in" <<TEXT
units lj
boundary f f f
read_data $folder/particles
pair_style zero 1.0
pair_coeff * *
neighbor 0.0 bin
neigh_modify every 1 delay 0 check no
thermo 1000
run 20
TEXT
echo "ranks: boxstream's pairs, ms; LAMMPS's pairs, ms"
for ranks in 1 2 4; do
  ours=$(mpirun -n "$ranks" "$program" "$n")
  theirs=$(mpirun -n "$ranks" lmp -in "$folder/in" -log none | awk -F'|' '
    /^Total # of neighbors/ { split($0, words, " = "); pairs = words[2] }
    / CPU use with / { use = $1 + 0 }
    /^Neigh / { ms = $4 * 1000 / 20 }
    END { printf "%d %.1f", pairs, ms * use / 100 }')
  echo "$ranks: $ours; $theirs"
  [[ ${ours% *} == "${theirs% *}" ]] || { echo "pairs differ" >&2 && exit 1; }
done
