# SPDX-License-Identifier: MIT
# The components of the installation have all files of PREFIX between them, each once, and in `library` are shared
# libraries alone. FOLDER is where they are installed.
file(GLOB_RECURSE whole RELATIVE ${PREFIX} ${PREFIX}/*)
list(SORT whole)
set(together "")
foreach(component IN ITEMS library development tools scenes licences)
  set(prefix ${FOLDER}/${component})
  file(REMOVE_RECURSE ${prefix})
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix} --component ${component}
    --config ${CONFIG} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB_RECURSE files RELATIVE ${prefix} ${prefix}/*)
  list(APPEND together ${files})
  if(component STREQUAL "library")
    list(FILTER files EXCLUDE REGEX "/lib[^/]*\\.so\\.[0-9.]+$")
    if(files)
      message(SEND_ERROR "in component library: ${files}")
    endif()
  endif()
endforeach()
list(SORT together)
if(NOT together STREQUAL whole)
  message(FATAL_ERROR "the components have\n${together}\nand the whole is\n${whole}")
endif()
