// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#if defined(__x86_64__) || defined(_M_X64)
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

  /// True if the caller's environment is like it, but for flags, so that there is nothing to enter. Where it takes long
  /// to find out, false.
  static bool is_here();

  /// Calls `work` in the caller's environment, which it may change. The flags inexact and denormal operand may be set
  /// already when it begins, and lost if it raises them: to restore them takes longer than to measure a distance.
  template <class Work>
  auto outside(Work&& work) {
    struct Back {
      DefaultFloatEnvironment& environment;
      ~Back() { environment.come_back(); }
    };
    go_out();
    const Back back{*this};
    return std::forward<Work>(work)();
  }

  /// Within `outside`: calls `work` in the default environment again. To make another one instead would cost more: its
  /// end has to take back what flags were raised.
  template <class Work>
  auto inside(Work&& work) {
    struct Out {
      DefaultFloatEnvironment& environment;
      ~Out() { environment.go_out(); }
    };
    come_back();
    const Out out{*this};
    return std::forward<Work>(work)();
  }

 private:
#if defined(__x86_64__) || defined(_M_X64)
  // All arithmetic goes by one register, which is written only if there is something to be changed.
  static constexpr unsigned flags = 0x3f, harmless_flags = 0x22, by_default = 0x1f80;

  static bool is_at(unsigned control) {
    return (control & ~flags) == by_default;
  }
  void enter() {
    caller_ = _mm_getcsr();
    if (!is_at(caller_)) _mm_setcsr(by_default);
    keep_order();
  }
  void leave() {
    keep_order();
    if (_mm_getcsr() != caller_) _mm_setcsr(caller_);
  }
  void go_out() {
    keep_order();
    const unsigned now = _mm_getcsr();
    ours_ = now & ~caller_;
    if (((now ^ caller_) & ~harmless_flags) == 0) return;
    ours_ = 0;
    _mm_setcsr(caller_);
  }
  void come_back() {
    caller_ = _mm_getcsr() & ~ours_;
    if (!is_at(caller_)) _mm_setcsr(by_default);
    keep_order();
  }

  unsigned caller_;
  unsigned ours_;  // flags that are left while outside
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
  void go_out() {
    leave();
  }
  void come_back() {
    enter();
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

inline bool DefaultFloatEnvironment::is_here() {
#if defined(__x86_64__) || defined(_M_X64)
  return is_at(_mm_getcsr());
#else
  return false;
#endif
}

}  // namespace boxstream::detail
