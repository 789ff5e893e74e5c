# SPDX-License-Identifier: MIT
# Builds the consumer's programs with nothing but the compiler and pkg-config, by the command in docs/build.md, and runs
# them. The standard is the user's: wherever it is set, no .pc file sets another.
string(REPLACE "," ";" components "${COMPONENTS}")
set(ENV{PKG_CONFIG_PATH} ${PREFIX}/${LIBDIR}/pkgconfig)
# Where shared libraries are that no system path has: that for C, and all if they were built so.
string(APPEND FLAGS " -Wl,-rpath,${PREFIX}/${LIBDIR}")
file(MAKE_DIRECTORY ${BUILD})

file(STRINGS ${PAGE} command REGEX "^g\\+\\+ .*pkg-config")
if(NOT command STREQUAL "g++ -std=c++17 main.cpp $(pkg-config --cflags --libs boxstream-bullet)")
  message(FATAL_ERROR "docs/build.md has another command than this test knows: '${command}'")
endif()

foreach(component IN LISTS components)
  set(compiler ${CXX})
  set(module boxstream-${component})
  set(source ${component}.cpp)
  if(component STREQUAL "core")
    set(module boxstream)
  elseif(component MATCHES "^bullet")
    string(REPLACE "_" "-" module boxstream-${component})
    set(source bullet.cpp)
  elseif(component STREQUAL "mpi")  # whose own command knows its flags
    set(compiler mpicxx)
    set(module boxstream)
  endif()

  string(REPLACE "g++" "${compiler} ${FLAGS} -o ${BUILD}/${component}" build "${command}")
  string(REPLACE "main.cpp" "${SOURCE}/${source}" build "${build}")
  string(REPLACE "boxstream-bullet" "${module}" build "${build}")
  message("${build}")
  execute_process(COMMAND sh -c "${build}" COMMAND_ERROR_IS_FATAL ANY)
  if(component STREQUAL "bullet_float64")
    set(precision double)
  else()
    set(precision float)
  endif()
  execute_process(COMMAND ${BUILD}/${component} ${precision} COMMAND_ERROR_IS_FATAL ANY)

  foreach(year IN ITEMS 17 20)
    file(WRITE ${BUILD}/standard.cpp "#if __cplusplus / 100 != 20${year}\n#error another standard than was set\n#endif\n")
    foreach(command_line IN ITEMS
        "-std=c++${year} standard.cpp $(pkg-config --cflags ${module})"
        "standard.cpp $(pkg-config --cflags ${module}) -std=c++${year}")
      execute_process(COMMAND sh -c "${compiler} ${FLAGS} -E ${command_line}" WORKING_DIRECTORY ${BUILD}
        OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
    endforeach()
  endforeach()
endforeach()
