// SPDX-License-Identifier: MIT
// In debug builds, a line before the crash of a manager of FCL that was given one of ours as `other`.
#pragma once

#if !defined(NDEBUG) && defined(__GNUC__) && defined(__has_include)
#if __has_include(<dlfcn.h>)
#define BOXSTREAM_FCL_KNOWS_ITS_CALLERS
#include <dlfcn.h>

#include <cstdio>
#include <cstring>

namespace boxstream::fcl::detail {

/// FCL's managers ask `other` for its size, by a virtual call, before they take it for one of their own type. `caller`
/// is where that call returns to; its name is known if FCL is a shared library.
inline void warn_of_wrong_other(void* caller) {
  Dl_info info;
  if (dladdr(caller, &info) == 0 || info.dli_sname == nullptr) return;
  const char* const name = info.dli_sname;
  const char* const of_fcl = std::strstr(name, "CollisionManagerI");
  if (std::strncmp(name, "_ZNK3fcl", 8) != 0 || of_fcl == nullptr) return;
  if (std::strstr(of_fcl, "collideEP") == nullptr && std::strstr(of_fcl, "distanceEP") == nullptr) return;
  std::fprintf(
      stderr,
      "boxstream::fcl: a manager of FCL was given one of boxstream as `other`. It takes every manager for one of "
      "its own type, and crashes now if it is not empty. Ask the one of boxstream instead, which takes managers of any "
      "type.\n");
}

}  // namespace boxstream::fcl::detail

#endif
#endif
