# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2154  # jobs is dev's
# The verb "cross" of ./dev, which sources this.
# shellcheck source=tests/sysroot.sh
. tests/sysroot.sh
# shellcheck source=tests/library/javascript/cross.sh
. tests/library/javascript/cross.sh

help_cross() {
  cat <<'TEXT'
usage: ./dev cross SYSTEM [--short] [OPTIONS OF ctest]
Builds the library and its tests for another system with Debian's cross compilers, in build/cross-SYSTEM, and runs them
there. Installs compilers and emulators as root, and unpacks libraries of that system below build/sysroot-SYSTEM.
  arm64    64-bit ARM under QEMU: core, worlds, objects, near, C, Bullet, FCL, libccd
  riscv64  64-bit RISC-V under QEMU: core, objects, near, C
  s390x    IBM Z, whose numbers are big-endian, under QEMU: core, worlds, objects, near, C
  i386     32-bit x86, as it is: core, worlds, objects, C
  windows  64-bit Windows under Wine: the short form alone
  wasm     WebAssembly in Node and Chromium, with Emscripten: orders of pairs, the npm package, the live page (docs/javascript.md)
  --short  as ./dev test --whole does: orders of pairs, near, C, files
docs/systems.md says what was last run, with what result.
TEXT
}

# System; compiler and emulator; where its libraries come from; folders of tests.
cross_systems='
arm64 g++-aarch64-linux-gnu,qemu-user packages library/core,library/world,library/objects,library/c,lab/formats/travel,library/bullet,library/fcl,library/ccd
riscv64 g++-riscv64-linux-gnu,qemu-user,dpkg-dev sources library/core,library/objects,library/c,lab/formats/travel
s390x g++-s390x-linux-gnu,qemu-user packages library/core,library/world,library/objects,library/c,lab/formats/travel
i386 g++-i686-linux-gnu packages library/core,library/world,library/objects,library/c,lab/formats/travel
windows g++-mingw-w64-x86-64-posix,wine64,dpkg-dev sources library/core,library/c,lab/formats/travel
'
# shellcheck disable=SC2034  # named by what the table says
{
  cross_packages=(libhwy-dev libgtest-dev librapidcheck-dev libfmt-dev)
  cross_packages_arm64=(libbullet-dev libccd-dev libeigen3-dev libfcl-dev libtbb-dev)
  cross_sources=(highway googletest fmtlib)
}

# Tests of the short form, whose programs are those of target boxstream_short_tests.
cross_short='simd_test|near_test|travel_test|^c\.'

verb_cross() {
  local system=${1:-} tools way rooms
  (($#)) && shift
  if declare -F "cross_$system" >/dev/null; then
    "cross_$system" "$@"
    return
  fi
  read -r _ tools way rooms < <(grep "^$system " <<<"$cross_systems") || { help_cross >&2 && die "which system?"; }
  # Some of the other tests use functions of POSIX.
  [[ $system != windows || ${1:-} == --short ]] || set -- --short "$@"
  verb_setup library
  IFS=, read -ra tools <<<"$tools"
  install_packages "${tools[@]}"
  local -n libraries=cross_$way more=cross_${way}_$system
  make_sysroot "$system" "$way" "${libraries[@]}" "${more[@]}"
  cross_test "$system" "${rooms//,/;}" "$@"
}

# cross_test SYSTEM ROOMS [--short] [OPTIONS OF ctest]
cross_test() {
  local system=$1 rooms=$2 build=build/cross-$1 targets=() only=()
  shift 2
  if [[ ${1:-} == --short ]]; then
    shift
    targets=(--target boxstream_short_tests)
    only=(-R "$cross_short")
  fi
  mkdir -p "$build"
  cmake -S . -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/cross/$system.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_RUNTIME_OUTPUT_DIRECTORY="$PWD/$build/bin" -DCMAKE_UNITY_BUILD=ON -DBOXSTREAM_WERROR=ON -DBOXSTREAM_BENCH=OFF \
    -DBOXSTREAM_DEMOS=OFF -DBOXSTREAM_PYTHON_PACKAGE=OFF -DBOXSTREAM_TESTS=ON -DBOXSTREAM_TESTS_OF="$rooms" \
    >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2 && die "configuring for $system failed"; }
  cmake --build "$build" --parallel "$jobs" "${targets[@]}" >&2 || die "building for $system failed: the first error above says where"
  ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel "$jobs" "${only[@]}" "$@" || die "tests failed on $system"
  say "$system: all tests passed"
}
