// SPDX-License-Identifier: MIT
#include "measure/other_load.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "measure/clock.hpp"

namespace boxstream::measure {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Of this process, and of its children that have ended.
double own_seconds() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    sum += seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
  return sum;
}

/// By the first line of /proc/stat: user, nice, system, idle, waiting for disks, interrupts (two), stolen.
double busy_seconds() {
  std::ifstream stat("/proc/stat");
  std::string name;
  double ticks[8] = {};
  stat >> name;
  for (double& tick : ticks) stat >> tick;
  if (!stat) return NAN;
  double sum = 0;
  for (const int i : {0, 1, 2, 5, 6, 7}) sum += ticks[i];
  return sum / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace

OtherLoad::Spent OtherLoad::now() {
  return {1e-9 * static_cast<double>(measure::now(Clock::wall).count()), busy_seconds(), own_seconds()};
}

double OtherLoad::processors() const {
  const Spent end = now();
  const double others = (end.busy - start_.busy) - (end.own - start_.own);
  // Ticks are coarser than the times of a process.
  return std::isnan(others) ? NAN : std::max(0.0, others / (end.elapsed - start_.elapsed));
}

}  // namespace boxstream::measure
