// SPDX-License-Identifier: MIT
#pragma once

#include <sched.h>

namespace boxstream::measure {

/// Keeps the calling thread, and threads that it starts, on one processor until it is destroyed: the last one that it
/// may use, as the first ones serve the machine's interrupts. A thread that moves finds cold caches.
class Pinned {
 public:
  Pinned() {
    CPU_ZERO(&before_);
    if (sched_getaffinity(0, sizeof before_, &before_) != 0) return;
    int last = -1;
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
      if (CPU_ISSET(cpu, &before_)) last = cpu;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(last, &one);
    is_pinned_ = sched_setaffinity(0, sizeof one, &one) == 0;
  }
  ~Pinned() {
    if (is_pinned_) sched_setaffinity(0, sizeof before_, &before_);
  }
  Pinned(const Pinned&) = delete;
  Pinned& operator=(const Pinned&) = delete;

 private:
  cpu_set_t before_;
  bool is_pinned_ = false;
};

}  // namespace boxstream::measure
