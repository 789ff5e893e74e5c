#!/bin/sh
# SPDX-License-Identifier: MIT
# man_pages.sh BOXSTREAM INTO VERSION: a page of the manual for each command, which help2man makes of what --help says.
set -eu
tool=$1 into=$2 version=$3

# page ABOUT WORD...: that of the command, and those of the commands below it. A date would make each build another page.
page() {
  about=$1
  shift
  name=$(echo boxstream "$@" | tr ' ' -)
  title=$(echo "$name" | tr '[:lower:]' '[:upper:]')
  help2man --no-info --name="$about" --version-string="$version" --help-option="$* --help" "$tool" |
    sed "s/^\.TH [^ ]* \"1\" \"[^\"]*\"/.TH $title \"1\" \"\"/; s/^boxstream \\\\- /$name \\\\- /" >"$into/$name.1"
  "$tool" "$@" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) */\1 /p' | while read -r command about; do
    page "$about" "$@" "$command"
  done
}
page "finds the pairs of axis-aligned boxes that touch"
