# SPDX-License-Identifier: MIT
# The examples, built against the installed package as their users would, print what their output.txt says.
# boxstream_example_test(<name> [<launcher with its options>])
function(boxstream_example_test name)
  set(source ${PROJECT_SOURCE_DIR}/demos/examples/${name})
  boxstream_project_test(example_${name} ${source}
    "${CMAKE_COMMAND};-DLAUNCHER=${ARGN};-DPROGRAM=./${name};-DEXPECTED=${source}/output.txt;-P;${CMAKE_CURRENT_SOURCE_DIR}/same_output.cmake"
    -DCMAKE_PREFIX_PATH=${prefix})
endfunction()

foreach(example IN ITEMS hello_core world_events filters boxes_as_data stored_index threads many_worlds)
  boxstream_example_test(${example})
endforeach()
if(TARGET boxstream::c)
  boxstream_example_test(hello_c)
endif()
foreach(engine IN ITEMS bullet fcl)
  if(TARGET boxstream::${engine})
    boxstream_example_test(hello_${engine})
  endif()
endforeach()
if(TARGET boxstream::bullet)
  boxstream_example_test(many_bullet_worlds)
  boxstream_example_test(bullet_rays_on_threads)
endif()
if(TARGET boxstream::mpi AND MPIEXEC_EXECUTABLE)
  boxstream_example_test(sand_mpi "${MPIEXEC_EXECUTABLE} -n 4")
  set_property(TEST package.example_sand_mpi APPEND PROPERTY ENVIRONMENT ${boxstream_mpi_environment})
endif()
