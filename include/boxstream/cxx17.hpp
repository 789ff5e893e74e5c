// SPDX-License-Identifier: MIT
// The first thing that every public header includes: one line instead of a hundred where the standard is too old.
#pragma once

#if __cplusplus < 201703L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 201703L)
#error boxstream needs C++17: compile with -std=c++17 or later, after any -std that pkg-config adds
#include <boxstream/needs-cxx17>  // which is not there: the compiler ends here
#endif
