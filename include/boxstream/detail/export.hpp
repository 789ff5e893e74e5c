// SPDX-License-Identifier: MIT
#pragma once

/// BOXSTREAM_API marks what shared libraries of boxstream export, and BOXSTREAM_LOCAL, while one is compiled, what they
/// keep of that. All else in them is hidden. On Windows the libraries for C++ are static.
#if defined(__ELF__) || defined(__APPLE__)
#define BOXSTREAM_API __attribute__((visibility("default")))
#else
#define BOXSTREAM_API
#endif
#if defined(BOXSTREAM_SHARED)
#define BOXSTREAM_LOCAL __attribute__((visibility("hidden")))
#else
#define BOXSTREAM_LOCAL
#endif
