// SPDX-License-Identifier: MIT
#pragma once

#include <new>
#include <stdexcept>
#include <utility>

#include <boxstream/bullet/precision.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Prints "boxstream::bullet: <reason>" to stderr and aborts. Bullet's callers can be built without exceptions, and its
/// interface has no error returns.
[[noreturn]] void fatal(const char* reason);

/// Calls `work`, which may run out of something; what a user's callback throws passes through.
template <class F>
decltype(auto) or_fatal(F&& work) {
  try {
    return std::forward<F>(work)();
  } catch (const std::bad_alloc&) {
    fatal("out of memory");
  } catch (const std::length_error&) {
    fatal("too many proxies or pairs");
  }
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
