#!/bin/sh
# SPDX-License-Identifier: MIT
# What `boxstream` is where the library is installed without its tool.
if [ "${1:-}" = try ]; then
  shift
  exec "$(dirname -- "$(readlink -f -- "$0")")/boxstream-try" "$@"
fi
echo "boxstream: here is only: boxstream try [OPTIONS] -- PROGRAM [ARGUMENTS]; simulations come with the tool: ./dev build" >&2
exit 2
