// SPDX-License-Identifier: MIT
#pragma once

/// BOXSTREAM_API marks what a shared library of boxstream exports, BOXSTREAM_LOCAL what it keeps of that. Everything
/// else is hidden. Both are the same for a static library, so that its objects are those of the shared one. On Windows
/// there is none for C++.
#if defined(__ELF__) || defined(__APPLE__)
#define BOXSTREAM_API __attribute__((visibility("default")))
#define BOXSTREAM_LOCAL __attribute__((visibility("hidden")))
#else
#define BOXSTREAM_API
#define BOXSTREAM_LOCAL
#endif
