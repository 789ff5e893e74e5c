# SPDX-License-Identifier: MIT
# Pages are put together by Node.js, that of the viewer from the sources in web/ and three.js, that of accuracy from those
# in ../accuracy_page and ECharts, and built into the library. Release archives have them ready, in bundled/. Where
# neither can be done the library is built without them, and says so when it is asked for a page.
set(page_names shell accuracy_shell)

# boxstream_use_pages(FOLDER): builds in what boxstream_bundle or a release archive has made there.
function(boxstream_use_pages folder)
  foreach(name IN LISTS page_names)
    target_sources(boxstream_view PRIVATE ${folder}/${name}.cpp)
    # A page in one literal is longer than compilers have to take; those we know do.
    set_source_files_properties(${folder}/${name}.cpp PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
  endforeach()
  # What pages of measurements are made of outside of the tool.
  set(BOXSTREAM_ACCURACY_TEMPLATE ${folder}/accuracy_shell.html CACHE INTERNAL "")
  if(BOXSTREAM_INSTALL)
    include(GNUInstallDirs)
    foreach(name IN LISTS page_names)
      install(FILES ${folder}/${name}.html.licences RENAME licences-of-${name}.txt
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licences)
    endforeach()
  endif()
endfunction()

set(web_source ${CMAKE_CURRENT_SOURCE_DIR}/web)
set(web_build ${CMAKE_CURRENT_BINARY_DIR}/web)
set(BOXSTREAM_VIEWER AUTO CACHE STRING "Build the viewer's page in: ON, OFF, or AUTO (when node and npm can make it)")
set_property(CACHE BOXSTREAM_VIEWER PROPERTY STRINGS AUTO ON OFF)

# Where node_modules are, for tests and pictures; empty where there is no viewer.
set(BOXSTREAM_WEB_PACKAGES "" CACHE INTERNAL "")

find_program(BOXSTREAM_NODE NAMES node nodejs)
find_program(BOXSTREAM_NPM NAMES npm)
mark_as_advanced(BOXSTREAM_NODE BOXSTREAM_NPM)

# Installs the packages of web/package-lock.json into the build tree, unless they are there.
function(boxstream_install_web_packages problem)
  set(${problem} "" PARENT_SCOPE)
  if(NOT BOXSTREAM_NODE OR NOT BOXSTREAM_NPM)
    set(${problem} "node or npm is not found" PARENT_SCOPE)
    return()
  endif()
  set(stamp ${web_build}/installed.txt)
  file(SHA256 ${web_source}/package-lock.json wanted)
  if(EXISTS ${stamp})
    file(READ ${stamp} installed)
  endif()
  if(installed STREQUAL wanted)
    return()
  endif()
  message(STATUS "boxstream: installing the npm packages of pages")
  file(COPY ${web_source}/package.json ${web_source}/package-lock.json ${web_source}/.npmrc DESTINATION ${web_build})
  execute_process(
    COMMAND ${BOXSTREAM_NPM} ci --prefer-offline --no-audit --no-fund --fetch-retries=1
    WORKING_DIRECTORY ${web_build} TIMEOUT 300
    RESULT_VARIABLE result OUTPUT_FILE ${web_build}/npm.log ERROR_FILE ${web_build}/npm.log)
  if(result EQUAL 0)
    file(WRITE ${stamp} ${wanted})
  else()
    set(${problem} "npm ci failed, see ${web_build}/npm.log" PARENT_SCOPE)
  endif()
endfunction()

if(NOT BOXSTREAM_VIEWER)
  set(web_problem "switched off")
elseif(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/bundled)
  boxstream_use_pages(${CMAKE_CURRENT_SOURCE_DIR}/bundled)
  return()
else()
  boxstream_install_web_packages(web_problem)
endif()
if(web_problem)
  if(BOXSTREAM_VIEWER AND NOT BOXSTREAM_VIEWER STREQUAL "AUTO")
    message(FATAL_ERROR "BOXSTREAM_VIEWER is ON, but the viewer cannot be built: ${web_problem}")
  endif()
  message(STATUS "boxstream: simulate --view and accuracy --page are left out: ${web_problem}")
  target_sources(boxstream_view PRIVATE no_shell.cpp)
  return()
endif()

set(BOXSTREAM_WEB_PACKAGES ${web_build} CACHE INTERNAL "")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${web_source}/package-lock.json)
# boxstream_bundle(FUNCTION FOLDER): the page of a folder, as FUNCTION.html in the build tree and as what FUNCTION returns.
function(boxstream_bundle name folder)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${name})
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/src/*.js)
  add_custom_command(
    OUTPUT ${out}.cpp ${out}.html ${out}.html.licences
    COMMAND ${BOXSTREAM_NODE} ${web_source}/build.mjs ${web_build} ${folder} ${out}.html ${out}.cpp ${name}
    DEPENDS ${sources} ${web_source}/build.mjs ${folder}/index.html ${folder}/style.css ${web_build}/installed.txt
    COMMENT "Bundling the page ${name}" VERBATIM)
  list(APPEND bundled ${out}.cpp ${out}.html ${out}.html.licences)
  set(bundled ${bundled} PARENT_SCOPE)
endfunction()
boxstream_bundle(shell ${web_source})
boxstream_bundle(accuracy_shell ${CMAKE_CURRENT_SOURCE_DIR}/../accuracy_page)
boxstream_use_pages(${CMAKE_CURRENT_BINARY_DIR})
# What goes into release archives.
add_custom_target(boxstream_pages DEPENDS ${bundled}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/bundled
  COMMAND ${CMAKE_COMMAND} -E copy_if_different ${bundled} ${CMAKE_CURRENT_BINARY_DIR}/bundled VERBATIM)
