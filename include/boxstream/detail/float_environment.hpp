// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#if defined(__SSE2_MATH__) || defined(_M_X64)
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

namespace boxstream::detail {

/// The floating-point environment that C++ starts with, for a scope: rounding to nearest, denormal numbers as they are,
/// no traps. So what is computed in it is the same on all threads of all hosts. The caller's environment is back at the
/// end, with the flags that it had.
///
/// Not for a scope that calls the caller's code, visitors, sinks and executors, unless within `outside`.
class DefaultFloatEnvironment {
 public:
  DefaultFloatEnvironment() { enter(); }
  ~DefaultFloatEnvironment() { leave(); }
  DefaultFloatEnvironment(const DefaultFloatEnvironment&) = delete;
  DefaultFloatEnvironment& operator=(const DefaultFloatEnvironment&) = delete;

  /// Calls `work` in the caller's environment, which it may change.
  template <class Work>
  auto outside(Work&& work) {
    struct Back {
      DefaultFloatEnvironment& environment;
      ~Back() { environment.enter(); }
    };
    leave();
    const Back back{*this};
    return std::forward<Work>(work)();
  }

 private:
#if defined(__SSE2_MATH__) || defined(_M_X64)
  // All arithmetic goes by one register, which is written only if there is something to be changed.
  static constexpr unsigned flags = 0x3f, by_default = 0x1f80;

  void enter() {
    caller_ = _mm_getcsr();
    if ((caller_ & ~flags) != by_default) _mm_setcsr(by_default);
    keep_order();
  }
  void leave() {
    keep_order();
    if (_mm_getcsr() != caller_) _mm_setcsr(caller_);
  }

  unsigned caller_;
#else
  void enter() {
    std::fegetenv(&caller_);
    std::fesetenv(FE_DFL_ENV);
    keep_order();
  }
  void leave() {
    keep_order();
    std::fesetenv(&caller_);
  }

  std::fenv_t caller_;
#endif

  /// What is computed from memory stays on its side of a change.
  static void keep_order() {
#if defined(__GNUC__)
    __asm__ volatile("" ::: "memory");
#endif
  }
};

}  // namespace boxstream::detail
