# SPDX-License-Identifier: MIT
# What Linux distributions ask of programs: checked copies, stack protectors, addresses that cannot be guessed, and nothing
# left to write to where functions are looked up. Not with sanitizers, which see more, and not for projects that add
# boxstream, which have flags of their own.
option(BOXSTREAM_HARDENED "Build libraries and programs hardened" ${PROJECT_IS_TOP_LEVEL})
set(boxstream_hardening_flags "")
if(BOXSTREAM_HARDENED AND NOT BOXSTREAM_SANITIZE AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
  set(boxstream_hardening_flags -fstack-protector-strong
    $<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-U_FORTIFY_SOURCE> $<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-D_FORTIFY_SOURCE=2>)
  add_link_options(-Wl,-z,relro,-z,now)
  include(CheckPIESupported)
  check_pie_supported(LANGUAGES CXX)
endif()
