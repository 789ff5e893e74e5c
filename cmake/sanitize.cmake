# SPDX-License-Identifier: MIT
# Sanitizers must cover every target of a program, the static libraries in it included, so they are set for the whole
# directory tree rather than on targets that could be forgotten.
set(BOXSTREAM_SANITIZE "" CACHE STRING "Sanitizers for all targets: empty, 'address,undefined', 'thread' or 'memory'")
set_property(CACHE BOXSTREAM_SANITIZE PROPERTY STRINGS "" "address,undefined" "thread" "memory")

if(BOXSTREAM_SANITIZE)
  if(NOT BOXSTREAM_SANITIZE MATCHES "^(address,undefined|address|undefined|thread|memory)$")
    message(FATAL_ERROR "BOXSTREAM_SANITIZE is '${BOXSTREAM_SANITIZE}'; known: address,undefined  address  undefined  thread  memory")
  endif()
  set(boxstream_sanitize_flags -fsanitize=${BOXSTREAM_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  if(BOXSTREAM_SANITIZE MATCHES "undefined" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND boxstream_sanitize_flags -fsanitize=float-cast-overflow)  # which clang counts among the undefined
  endif()
  add_compile_options(${boxstream_sanitize_flags})
  add_link_options(${boxstream_sanitize_flags})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    # As GCC says it.
    if(BOXSTREAM_SANITIZE MATCHES "address")
      add_compile_definitions(__SANITIZE_ADDRESS__)
    elseif(BOXSTREAM_SANITIZE MATCHES "thread")
      add_compile_definitions(__SANITIZE_THREAD__)
    endif()
  endif()
endif()

# Fuzzers are steered by what all the code of a program reaches, so that it is measured in the whole tree too.
option(BOXSTREAM_FUZZ "Build the fuzzers, too; takes clang" OFF)
if(BOXSTREAM_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "BOXSTREAM_FUZZ takes clang: cmake --preset asan-ubsan")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)
  add_link_options(-fsanitize=fuzzer-no-link)
endif()
