# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2154  # jobs is dev's
# The verbs "dist" and "deb" of ./dev, which sources this.

help_packaging() {
  case "$1" in
    dist) cat <<'TEXT' ;;
usage: ./dev dist
Makes the release archive of the last commit, out/boxstream-VERSION.tar.gz: the sources, and the viewer's pages put
together, so that whoever builds them fetches nothing and needs no Node.js.
TEXT
    deb) cat <<'TEXT' ;;
usage: ./dev deb [--clean-root]
Builds Debian's packages from the release archive (./dev dist), checks them with lintian, and leaves them in out/deb.
  --clean-root  then installs them in a new Debian below build/, and does there what users would: debian/tests
TEXT
  esac
}

package_version() { sed -n 's/^project(boxstream VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt; }

verb_dist() {
  local name stage=build/dist
  name=boxstream-$(package_version)
  verb_setup library tool formats
  mkdir -p "$stage" out
  # In a folder of its own: the demo's leaves the viewer out.
  { cmake --preset demo -B build/pages -DBOXSTREAM_VIEWER=ON -DBOXSTREAM_DEMOS_WITHOUT= &&
    cmake --build build/pages --target boxstream_pages; } >build/dist.log 2>&1 ||
    die "putting the pages together failed: see build/dist.log"
  rm -rf "${stage:?}/$name"
  git archive --prefix="$name/" HEAD | tar -x -C "$stage"
  cp -r build/pages/demos/pictures/viewer/bundled "$stage/$name/demos/pictures/viewer/"
  tar -C "$stage" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$(git log -1 --format=%ct)" -c "$name" |
    gzip -9n >"out/$name.tar.gz"
  printf 'archive: %s\n' "$PWD/out/$name.tar.gz"
}

verb_deb() {
  [[ -z ${1:-} || $1 == --clean-root ]] || die "no option $1; there is --clean-root"
  local version folder=build/deb
  version=$(package_version)
  verb_setup packaging library tool formats python
  verb_dist
  rm -rf "$folder" && mkdir -p "$folder" out/deb
  cp "out/boxstream-$version.tar.gz" "$folder/boxstream_$version.orig.tar.gz"
  tar -C "$folder" -xf "out/boxstream-$version.tar.gz"
  # Without debug symbols, which take half of the time; with the cache of compilations of the person who builds.
  (cd "$folder/boxstream-$version" && CCACHE_DIR=$(ccache --get-config cache_dir 2>/dev/null) DEB_CXXFLAGS_STRIP=-g \
    DEB_BUILD_OPTIONS="noautodbgsym parallel=$jobs" dpkg-buildpackage -us -uc) >"$folder/build.log" 2>&1 ||
    { tail -n 40 "$folder/build.log" >&2 && die "dpkg-buildpackage failed: see $folder/build.log"; }
  lintian --fail-on error "$folder"/*.changes || die "lintian found errors, see above"
  rm -f out/deb/* && cp "$folder"/*.deb out/deb/
  printf 'packages: %s/out/deb\n' "$PWD"
  [[ ${1:-} != --clean-root ]] || try_in_clean_root
}

# What debian/tests say, in a system that has nothing but apt and these packages.
try_in_clean_root() {
  ((EUID == 0)) || die "a new Debian takes root: sudo ./dev deb --clean-root"
  local root=build/clean-root
  rm -rf "$root"
  # With apt's lists: autopkgtest installs apt-utils before it updates them.
  mmdebstrap --quiet --variant=apt --skip=cleanup/apt/lists bookworm "$root" || die "mmdebstrap could not make $root"
  # In a namespace of its own, so that nothing stays mounted.
  # shellcheck disable=SC2016  # the inner shell's
  unshare --mount sh -ec 'mount -t proc proc "$1/proc"; mount --rbind /dev "$1/dev"; shift; exec "$@"' - "$root" \
    autopkgtest out/deb/*.deb "build/deb/boxstream-$(package_version)/" -- chroot "$PWD/$root" ||
    die "debian/tests failed in $root, see above"
}
