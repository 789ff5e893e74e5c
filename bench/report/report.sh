# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# The verb "report" of ./dev, which sources this.

help_report() {
  cat <<'TEXT'
usage: ./dev report [ID...] [--smoke] [--repeats N] [--instructions] [--into DIR | --commit-data] [--page-only] [--picture]
                    [--thumbnails]
Sets up, builds and measures the experiments of bench/report/experiments, all or those named, writes a table of each to
out/report, and makes the page out/report/index.html. Of an experiment that was not measured here the page shows the
figures in bench/report/results.txt, and says of which machine and day they are.
  --smoke         three points of each at small sizes, into out/report/smoke, with a page there: shows that all works
  --repeats N     timed runs of each candidate (9)
  --instructions  counts instructions with callgrind as well, of the small sizes: takes about thirty times as long as these
  --into DIR      tables go there
  --commit-data   takes the tables into bench/report/results.txt: figures that are kept
  --page-only     measures and compiles nothing, makes the page of what is there
  --picture       afterwards takes a picture of the page's first screen: docs/pictures/report.png
  --thumbnails    draws the small pictures of the experiments' scenes again, which are kept in bench/report/page/thumbnails.zip
docs/report.md says how to read the page and how to add an experiment.
TEXT
}

report_ids() { find bench/report/experiments -name '*.json' -printf '%f\n' | sed 's|\.json$||' | sort -V; }

# The folder that has node_modules of pages: the one that is given, that of a build, if there is one, else one of its own.
report_packages() {
  if [[ ${BOXSTREAM_WEB_PACKAGES:-} ]]; then
    echo "$BOXSTREAM_WEB_PACKAGES"
    return
  fi
  local built=build/release/demos/pictures/viewer/web own=out/report/packages source=demos/pictures/viewer/web
  local wanted at
  wanted=$(sha256sum <"$source/package-lock.json" | cut -d' ' -f1)
  for at in "$built" "$own"; do
    if [[ $(cat "$at/installed.txt" 2>/dev/null) == "$wanted" ]]; then
      echo "$at"
      return
    fi
  done
  mkdir -p "$own"
  cp "$source"/package.json "$source"/package-lock.json "$source"/.npmrc "$own"
  (cd "$own" && npm ci --prefer-offline --no-audit --no-fund --fetch-retries=1 >npm.log 2>&1) || return 1
  printf %s "$wanted" >"$own/installed.txt"
  echo "$own"
}

# The page of the tables that there are; nothing is compiled for it.
report_page() {
  local packages template=out/report/template.html
  packages=$(report_packages) || die "the page could not be made: it needs node and npm"
  mkdir -p out/report
  if ! node demos/pictures/viewer/web/build.mjs "$packages" demos/pictures/accuracy_page "$template" ||
    ! python3 bench/report/page/page.py --template "$template" "$@"; then
    die "the page could not be made: it needs node, npm and python3"
  fi
}

# Runs a command whose timed regions have their instructions counted (demos/measure/stopwatch.hpp). Its first argument
# is the name of what is counted.
count_instructions() {
  local dump=$PWD/out/counts/$1.callgrind log=out/counts/$1.log
  say "$1: counting instructions"
  mkdir -p out/counts
  BOXSTREAM_CALLGRIND=$dump valgrind --tool=callgrind --instr-atstart=no --callgrind-out-file="$dump" "${@:2}" \
    >"$log" 2>&1 || die "counting instructions of $1 failed: $log"
  rm -f "$dump" "$dump".*
}

# Callgrind takes a machine that has no part in times: these go elsewhere, and the page takes the counts alone.
report_instructions() {
  local into=$1/counts id
  mkdir -p "$into"
  for id in "${@:2}"; do
    count_instructions "$id" build/release/bench/report/boxstream_report "bench/report/experiments/$id.json" \
      --smoke --repeats 1 --into "$into"
  done
}

help_prices() {
  cat <<'TEXT'
usage: ./dev prices [--times | --instructions]
Builds the tool and measures what each effect of a scene costs: its time (which takes three minutes of an idle machine),
and its instructions, counted by callgrind (ten minutes of any machine). Either alone keeps what there is of the other.
The figures go to demos/simulation/effects/prices.json and into the table of docs/effects.md.
TEXT
}

verb_prices() {
  local prices=(build/release/bin/boxstream prices --json demos/simulation/effects/prices.json --into docs/effects.md)
  [[ ${1:-} =~ ^(|--times|--instructions)$ ]] || die "unknown option $1; see ./dev help prices"
  verb_setup
  build_preset release boxstream_tool >&2
  [[ ${1:-} == --instructions ]] || "${prices[@]}" || die "measuring prices failed"
  [[ ${1:-} == --times ]] || count_instructions prices "${prices[@]}"
}

# Scenes of a few hundred bodies each; those of experiments at that scale.
report_thumbnails() {
  local scenes=(bench/report/scenes/*.json) name
  for name in jolt_pyramid@0.2 box3d_large_pyramid@0.04 bullet{1,3}@0.05 bullet2@0.2 bullet{4,5}@0.12 bullet8@0.06 pile@0.05 \
    bin_picking@0.2 hopper@0.1 ragdolls@0.1 jolt_convex_vs_mesh@0.1 hard/stack_of_plates@1 \
    broadmark_{fall,gravity,brownian}_{assorted,cubes}@0.1; do
    scenes+=("demos/scenes/${name/@/.json@}")
  done
  build_preset release boxstream_tool >&2
  /usr/bin/python3 bench/report/page/thumbnails.py build/release/bin/boxstream "${scenes[@]}" || die "no small pictures"
}

report_picture() {
  local packages
  packages=$(report_packages) || die "no picture was taken: it needs node and npm"
  BOXSTREAM_WEB_PACKAGES=$(realpath "$packages") node bench/report/picture.mjs "$1" docs/pictures/report.png ||
    die "no picture was taken: it needs chromium and the packages of the viewer"
  say "picture: docs/pictures/report.png"
}

verb_report() {
  local into="" kept="" repeats=9 smoke=() instructions="" page_only="" picture="" thumbnails="" ids=() id page=out/report/index.html
  while (($#)); do
    case "$1" in
      --smoke) smoke=(--smoke) ;;
      --instructions) instructions=1 ;;
      --page-only) page_only=1 ;;
      --picture) picture=1 ;;
      --thumbnails) thumbnails=1 ;;
      --commit-data) kept=bench/report/results.txt into=out/report/kept ;;
      --repeats | --into)
        (($# > 1)) || die "$1 takes a value"
        if [[ $1 == --into ]]; then into=$2; else repeats=$2; fi
        shift
        ;;
      -*) die "no option $1; ./dev report --help lists them" ;;
      *) ids+=("$1") ;;
    esac
    shift
  done
  [[ $repeats =~ ^[1-9][0-9]{0,2}$ ]] || die "--repeats takes a number from 1 to 999, not $repeats"
  for id in "${ids[@]}"; do
    [[ -f bench/report/experiments/$id.json ]] || die "no experiment $id; there are: $(report_ids | xargs)"
  done
  ((${#ids[@]})) || mapfile -t ids < <(report_ids)
  if [[ ${smoke[*]} ]]; then
    [[ ! $kept ]] || die "--smoke and --commit-data: figures that are kept are not those of small sizes"
    into=${into:-out/report/smoke} page=$into/index.html
  fi
  into=${into:-out/report}
  if [[ ! $page_only ]]; then
    [[ ! $kept ]] || rm -rf "$into"
    verb_setup
    build_preset release boxstream_report >&2
    local files=("${ids[@]/#/bench/report/experiments/}")
    local -x BOXSTREAM_COMMIT
    # Tables that were made before this one are no change of what is measured.
    BOXSTREAM_COMMIT=$(git rev-parse --short=8 HEAD 2>/dev/null || true)
    [[ -z $(git status --porcelain -uno -- . ':!bench/report/results.txt' 2>/dev/null) ]] || BOXSTREAM_COMMIT+=-dirty
    build/release/bench/report/boxstream_report "${files[@]/%/.json}" "${smoke[@]}" --repeats "$repeats" --into "$into" || die "measuring failed"
    [[ ! $instructions ]] || report_instructions "$into" "${ids[@]}"
    [[ ! $kept ]] || python3 bench/report/page/data.py "$kept" "$into" || die "the tables in $into were not taken into $kept"
  fi
  [[ ! $thumbnails ]] || report_thumbnails
  # Small sizes have a page of their own, so that none of them stands among the others.
  if [[ ${smoke[*]} ]]; then
    report_page --fresh "$into" --stored "" --out "$page"
  else
    report_page --fresh "$into" --out "$page"
  fi
  say "page: $PWD/$page"
  [[ ! $picture ]] || report_picture "$page"
}
