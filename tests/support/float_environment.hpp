// SPDX-License-Identifier: MIT
#pragma once

#include <cfenv>
#include <functional>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

/// Floating-point environments that a host may have set. Each function runs `work` in one and leaves the default one
/// behind; make inputs and compare results outside, for the environment changes those too.
namespace boxstream::tests {

/// Those that C has. That an operand was denormal, x86 has a flag for as well, which some C libraries count among all.
inline constexpr int flags_of_c = FE_DIVBYZERO | FE_INEXACT | FE_INVALID | FE_OVERFLOW | FE_UNDERFLOW;

/// Rounding to nearest excepted, that being the default.
inline constexpr int rounding_modes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

inline void with_rounding(int mode, const std::function<void()>& work) {
  std::fesetround(mode);
  work();
  std::fesetround(FE_TONEAREST);
}

#if defined(__SSE2__)
/// Denormal operands taken for zero and denormal results made zero.
#define BOXSTREAM_TESTS_CAN_FLUSH_DENORMALS
inline void with_denormals_flushed(const std::function<void()>& work) {
  constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | flush_to_zero | denormals_are_zero);
  work();
  _mm_setcsr(before);
}
#endif

#if defined(__GLIBC__) && defined(__x86_64__)
/// A trap kills the process, and so fails the test.
#define BOXSTREAM_TESTS_CAN_TRAP
inline void with_traps(int exceptions, const std::function<void()>& work) {
  std::feclearexcept(FE_ALL_EXCEPT);
  feenableexcept(exceptions);
  work();
  fedisableexcept(FE_ALL_EXCEPT);
  std::feclearexcept(FE_ALL_EXCEPT);
}
#endif

/// An environment of several, for a scope. In the first nothing is changed.
class Mood {
 public:
  static constexpr unsigned count = 9;

  explicit Mood(unsigned number) {
    std::fegetenv(&before_);
    if (number >= 1 && number <= 3) std::fesetround(rounding_modes[number - 1]);
#if defined(__SSE2__)
    constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
    if (number == 4 || number == 5 || number == 8) _mm_setcsr(_mm_getcsr() | flush_to_zero | denormals_are_zero);
    if (number == 6) _mm_setcsr(_mm_getcsr() | denormals_are_zero);
#endif
    if (number == 8) std::fesetround(FE_DOWNWARD);
#if defined(__GLIBC__) && defined(__x86_64__)
    std::feclearexcept(FE_ALL_EXCEPT);
    if (number == 5 || number == 7) feenableexcept(FE_ALL_EXCEPT);
#endif
    now_ = control();
  }
  ~Mood() {
    std::fesetenv(&before_);
  }
  Mood(const Mood&) = delete;
  Mood& operator=(const Mood&) = delete;

  /// True if the environment is this one still: flags, which comparisons of the caller's may raise, do not count.
  bool is_on() const {
    return control() == now_;
  }

 private:
  static unsigned control() {
#if defined(__SSE2__)
    return _mm_getcsr() & ~0x3fu;
#else
    return static_cast<unsigned>(std::fegetround());
#endif
  }

  std::fenv_t before_;
  unsigned now_;
};

}  // namespace boxstream::tests
