# SPDX-License-Identifier: MIT
# Highway's headers alone, without the folder of the system's other headers around them.
set(headers ${CMAKE_BINARY_DIR}/highway)
file(MAKE_DIRECTORY ${headers})
file(CREATE_LINK /usr/include/hwy ${headers}/hwy SYMBOLIC)
add_library(hwy::hwy INTERFACE IMPORTED)
target_include_directories(hwy::hwy INTERFACE ${CMAKE_CURRENT_LIST_DIR} ${headers})
target_compile_definitions(hwy::hwy INTERFACE HWY_COMPILE_ONLY_STATIC)
