# SPDX-License-Identifier: MIT
# A port that lies in the sources it builds: vcpkg install boxstream --overlay-ports=cmake/packaging/vcpkg
cmake_path(ABSOLUTE_PATH CMAKE_CURRENT_LIST_DIR NORMALIZE OUTPUT_VARIABLE port)
cmake_path(SET source NORMALIZE "${port}/../../../..")
vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES
  bullet BOXSTREAM_BULLET
  c BOXSTREAM_C
  ccd BOXSTREAM_CCD
  fcl BOXSTREAM_FCL
  tbb BOXSTREAM_TBB)
vcpkg_cmake_configure(SOURCE_PATH "${source}" OPTIONS
  -DBOXSTREAM_TESTS=OFF -DBOXSTREAM_BENCH=OFF -DBOXSTREAM_DEMOS=OFF -DBOXSTREAM_PYTHON_PACKAGE=OFF
  -DBOXSTREAM_HARDENED=OFF -DBOXSTREAM_MPI=OFF ${features})
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/boxstream)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${source}/LICENSE")
