# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2154  # jobs is dev's
# The verb "cross" of ./dev, which sources this.

help_cross() {
  cat <<'TEXT'
usage: ./dev cross arm64
Builds the core and the C interface for another system with Debian's cross compilers, in build/cross-SYSTEM, and runs their tests
there under QEMU's user mode: the recorded orders of pairs, and the C interface against brute force. Installs Debian packages
of that system, as root.
  arm64  64-bit ARM, NEON
TEXT
}

verb_cross() {
  local system=${1:-} triplet packages missing=() root=() build package
  case "$system" in
    arm64) triplet=aarch64-linux-gnu ;;
    *) die "which system? there is: arm64" ;;
  esac
  verb_setup library tests
  packages=("g++-$triplet" qemu-user "libhwy-dev:$system" "libgtest-dev:$system" "librapidcheck-dev:$system")
  for package in "${packages[@]}"; do
    dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done
  if ((${#missing[@]})); then
    ((EUID == 0)) || root=(sudo)
    say "dev: installing ${missing[*]}"
    "${root[@]}" dpkg --add-architecture "$system"
    "${root[@]}" apt-get -q update >/dev/null || die "no package source reached"
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q install -y --no-install-recommends "${missing[@]}" >/dev/null ||
      die "apt-get could not install the packages of $system"
  fi
  build=build/cross-$system
  cmake -S . -B "$build" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/cross/$system.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache || true)" -DBOXSTREAM_DEMOS=OFF -DBOXSTREAM_BENCH=OFF -DBOXSTREAM_BULLET=OFF \
    -DBOXSTREAM_FCL=OFF -DBOXSTREAM_CCD=OFF -DBOXSTREAM_TBB=OFF -DBOXSTREAM_TESTS=ON >/dev/null || die "configuring $build failed"
  cmake --build "$build" --parallel "$jobs" --target boxstream_golden_order boxstream_c_test || die "building for $system failed"
  local emulator=(qemu-"${triplet%%-*}" -L "/usr/$triplet")
  "${emulator[@]}" "$build/tests/c/boxstream_c_test" >/dev/null || die "$system: the C interface is wrong"
  "${emulator[@]}" "$build/tests/core/boxstream_golden_order" | diff -q - tests/core/golden_order.txt >/dev/null ||
    die "$system: pairs come in another order than tests/core/golden_order.txt has"
  say "$system: pairs and orders are those of tests/core/golden_order.txt"
}
