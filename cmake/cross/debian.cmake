# SPDX-License-Identifier: MIT
# What the toolchain files share: libraries are those that ./dev cross put below build/sysroot-SYSTEM, programs are this
# machine's.
set(root ${CMAKE_CURRENT_LIST_DIR}/../../build/sysroot-${system})
set(CMAKE_FIND_ROOT_PATH ${root})
set(CMAKE_PREFIX_PATH /usr)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind IN ITEMS LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${root})
set(ENV{PKG_CONFIG_LIBDIR} ${root}/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/pkgconfig:${root}/usr/share/pkgconfig)
