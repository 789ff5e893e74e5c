# SPDX-License-Identifier: MIT
# Each public header alone in a C++17 translation unit, twice included, with warnings as errors; all of them linked
# into one program with another user of the main header, so that a definition that is not inline shows. Headers in a
# folder named detail are none: public ones include them.
function(boxstream_headers_test name include_dir main_header library)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${include_dir} ${include_dir}/*.hpp)
  list(FILTER headers EXCLUDE REGEX "/detail/")
  set(sources "")
  foreach(HEADER IN LISTS headers)
    string(MAKE_C_IDENTIFIER ${HEADER} identifier)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}/${identifier}.cpp)
    configure_file(header_alone.cpp.in ${source} @ONLY)
    list(APPEND sources ${source})
  endforeach()
  add_executable(boxstream_${name} headers_main.cpp ${sources})
  set_target_properties(boxstream_${name} PROPERTIES CXX_STANDARD 17)
  target_link_libraries(boxstream_${name} PRIVATE ${library} boxstream_warnings)
  target_compile_options(boxstream_${name} PRIVATE -Werror)
  target_compile_definitions(boxstream_${name} PRIVATE
    MAIN_HEADER=<${main_header}> EXPECTED_MAJOR=${PROJECT_VERSION_MAJOR} EXPECTED_MINOR=${PROJECT_VERSION_MINOR}
    EXPECTED_PATCH=${PROJECT_VERSION_PATCH})
  add_test(NAME package.${name} COMMAND boxstream_${name})
  set_tests_properties(package.${name} PROPERTIES LABELS package)
endfunction()

boxstream_headers_test(headers_core ${PROJECT_SOURCE_DIR}/include boxstream/boxstream.hpp boxstream::boxstream)
foreach(module IN ITEMS bullet bullet_float64)
  if(TARGET boxstream::${module})
    boxstream_headers_test(headers_${module}
      ${PROJECT_SOURCE_DIR}/adapters/bullet/include boxstream/bullet.hpp boxstream::${module})
  endif()
endforeach()
if(TARGET boxstream::ccd)
  boxstream_headers_test(headers_ccd ${PROJECT_SOURCE_DIR}/adapters/ccd/include boxstream/ccd.hpp boxstream::ccd)
endif()
if(TARGET boxstream::fcl)
  boxstream_headers_test(headers_fcl ${PROJECT_SOURCE_DIR}/adapters/fcl/include boxstream/fcl.hpp boxstream::fcl)
endif()
if(TARGET boxstream::mpi)
  boxstream_headers_test(headers_mpi ${PROJECT_SOURCE_DIR}/adapters/mpi/include boxstream/mpi.hpp boxstream::mpi)
endif()
if(TARGET boxstream::tbb)
  boxstream_headers_test(headers_tbb ${PROJECT_SOURCE_DIR}/adapters/tbb/include boxstream/tbb.hpp boxstream::tbb)
endif()

set(include_directories ${PROJECT_SOURCE_DIR}/include)
foreach(adapter IN ITEMS bullet ccd fcl mpi tbb)
  list(APPEND include_directories ${PROJECT_SOURCE_DIR}/adapters/${adapter}/include)
endforeach()
string(REPLACE ";" "," include_directories "${include_directories}")
add_test(NAME package.headers_need_cxx17 COMMAND ${CMAKE_COMMAND} -DCXX=${CMAKE_CXX_COMPILER}
  -DDIRECTORIES=${include_directories} -DBUILD=${CMAKE_CURRENT_BINARY_DIR} -P ${CMAKE_CURRENT_SOURCE_DIR}/needs_cxx17.cmake)
set_tests_properties(package.headers_need_cxx17 PROPERTIES LABELS package)
