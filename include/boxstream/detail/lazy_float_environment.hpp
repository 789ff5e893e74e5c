// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <boxstream/detail/float_environment.hpp>

#if !(defined(__x86_64__) || defined(_M_X64))
#include <cfenv>
#endif

namespace boxstream::detail {

/// Like DefaultFloatEnvironment, for queries of about fifty nanoseconds: reading the control register once takes a
/// tenth of that. The environment is entered only when there is something to compute. If the caller already has the
/// default one, exception flags that are raised inside stay set.
class LazyFloatEnvironment {
 public:
  LazyFloatEnvironment() { enter(); }
  ~LazyFloatEnvironment() { go_out(); }
  LazyFloatEnvironment(const LazyFloatEnvironment&) = delete;
  LazyFloatEnvironment& operator=(const LazyFloatEnvironment&) = delete;

  /// For the caller's code, which may change its environment.
  void go_out() {
    keep_order();
    if (is_inside_) leave();
    is_inside_ = false;
  }
  void come_in() {
    if (!is_inside_) enter();
    is_inside_ = true;
    keep_order();
  }

 private:
#if defined(__x86_64__) || defined(_M_X64)
  void enter() {
    caller_ = _mm_getcsr();
    is_callers_ = (caller_ & ~flags) == by_default;
    if (!is_callers_) _mm_setcsr(by_default);
    keep_order();
  }
  void leave() {
    if (!is_callers_) _mm_setcsr(caller_);
  }

  static constexpr unsigned flags = 0x3f, by_default = 0x1f80;
  unsigned caller_;
  bool is_callers_;
#else
  void enter() {
    std::fegetenv(&caller_);
    std::fesetenv(FE_DFL_ENV);
    keep_order();
  }
  void leave() {
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

  bool is_inside_ = true;
};

}  // namespace boxstream::detail
