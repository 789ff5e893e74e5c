// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <thread>

namespace boxstream::threads {

/// Tells the processor that a loop waits, for about a tenth of a microsecond or less.
inline void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__) || defined(__arm__)
  __asm__ __volatile__("yield");
#endif
}

/// Waits for `until()` without sleeping, at most that long. Returns whether it came true. A `polite` wait lets other
/// threads run meanwhile: for where threads are more than processors.
template <class Until>
bool spin(std::chrono::nanoseconds most, bool polite, const Until& until) {
  using Clock = std::chrono::steady_clock;
  constexpr int looks = 32;  // between two of the clock, which takes as long as several
  for (const Clock::time_point end = Clock::now() + most; Clock::now() < end;)
    for (int i = 0; i < looks; ++i) {
      if (until()) return true;
      if (polite)
        std::this_thread::yield();
      else
        pause();
    }
  return until();
}

}  // namespace boxstream::threads
