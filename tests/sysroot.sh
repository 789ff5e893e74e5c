# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2154  # jobs is dev's
# Libraries of another system, for ./dev cross: in build/sysroot-SYSTEM. APT gets a state of its own, in build/apt-SYSTEM,
# so that neither the packages nor the architectures of this machine change.

# apt_apart SYSTEM ARCHITECTURE ARGUMENT...
apt_apart() {
  local state=$PWD/build/apt-$1 architecture=$2
  shift 2
  (cd "$state" && apt-get -q -y --no-install-recommends -o APT::Architecture="$architecture" \
    -o APT::Architectures::="$architecture" -o Dir::State="$state" -o Dir::State::status="$state/status" \
    -o Dir::Cache="$state" -o Debug::NoLocking=1 "$@")
}

# fetch_packages SYSTEM PACKAGE...: Debian's for that system, with what they depend on.
fetch_packages() {
  local system=$1 root=build/sysroot-$1 package
  # As in setup, only the installation decides.
  apt_apart "$system" "$system" update || true
  apt_apart "$system" "$system" install --download-only "${@:2}"
  for package in build/apt-"$system"/archives/*.deb; do dpkg -x "$package" "$root"; done
  # Debian's libccd names this library by its path on a machine of that system.
  find "$root" -name 'ccd-targets*.cmake' -exec sed -i 's,/usr/lib/[a-z0-9_-]*/libm\.so,m,' {} +
}

# fetch_sources SYSTEM PACKAGE...: for one that Debian has no packages of. They become static libraries.
fetch_sources() {
  local system=$1 apart=build/apt-$1 file source
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.{list,sources}; do
    [[ ! -f $file ]] || sed 's/^Types: deb$/Types: deb-src/; s/^deb /deb-src /' "$file" >"$apart/sources/${file##*/}"
  done
  local only=(-o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$PWD/$apart/sources")
  apt_apart "$system" amd64 "${only[@]}" update || true
  apt_apart "$system" amd64 "${only[@]}" source "${@:2}"
  for source in "$apart"/*-[0-9]*/; do
    cmake -S "$source" -B "$source/build" -G Ninja --no-warn-unused-cli -DCMAKE_BUILD_TYPE=Release \
      -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/cross/$system.cmake" -DCMAKE_INSTALL_PREFIX="$PWD/build/sysroot-$system/usr" \
      -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache || true)" -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF \
      -DHWY_ENABLE_TESTS=OFF -DHWY_ENABLE_EXAMPLES=OFF -DHWY_ENABLE_CONTRIB=OFF -DBUILD_GMOCK=OFF -DFMT_TEST=OFF -DFMT_DOC=OFF
    cmake --build "$source/build" --parallel "$jobs" --target install
  done
}

# make_sysroot SYSTEM packages|sources PACKAGE...: once.
make_sysroot() {
  local system=$1 way=$2 root=build/sysroot-$1 apart=build/apt-$1 log=build/sysroot-$1.log
  [[ ! -f $root/complete ]] || return 0
  say "dev: fetching libraries of $system: ${*:3}"
  rm -rf "$root" "$apart"
  mkdir -p "$root" "$apart"/{lists,archives}/partial "$apart/sources"
  : >"$apart/status"
  # set -e does not reach into a condition.
  (set -e && "fetch_$way" "$system" "${@:3}") >"$log" 2>&1 </dev/null &
  wait $! || die "no libraries of $system: see the end of $log"
  touch "$root/complete"
  rm -rf "$apart"
}
