# SPDX-License-Identifier: MIT
# The version of the headers, as the package of the system says it.
file(STRINGS /usr/include/hwy/highway.h numbers REGEX "define HWY_(MAJOR|MINOR|PATCH) ")
list(TRANSFORM numbers REPLACE ".* " "")
list(JOIN numbers . PACKAGE_VERSION)
if(PACKAGE_VERSION VERSION_GREATER_EQUAL PACKAGE_FIND_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
