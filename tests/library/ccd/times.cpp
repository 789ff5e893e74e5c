// SPDX-License-Identifier: MIT
// Processor times and statuses of `penetration` and `intersect` for each pair of kinds, lying deep in one another:
//   boxstream_ccd_times [pairs of each kind [largest ratio of the sizes]]
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "symmetric_pairs.hpp"

namespace boxstream::ccd_test {
namespace {

double microseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

struct Row {
  std::vector<double> times;
  int of[4] = {0, 0, 0, 0};

  template <class Ask>
  void time(const Ask& ask) {
    double best = 1e300;
    // The first of three calls also pays for cold memory, and a busy machine for any one of them.
    for (int i = 0; i < 3; ++i) {
      const double begun = microseconds();
      const auto answer = ask();
      best = std::min(best, microseconds() - begun);
      if (i == 0) ++of[static_cast<int>(answer.status)];
    }
    times.push_back(best);
  }

  void print(const char* a, const char* b, const char* what) {
    std::sort(times.begin(), times.end());
    std::printf("| %s, %s | %s | %.1f | %.1f | %.1f | %d | %d | %d |\n", a, b, what, times[times.size() / 2],
                times[times.size() * 99 / 100], times.back(), of[0], of[1], of[2]);
  }
};

void run(std::uint64_t pairs, double most_ratio) {
  std::printf("| pair | call | median us | 99 %% | worst | ok | inexact | iteration limit |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (int a = 0; a < kinds_and_big_hulls; ++a)
    for (int b = a; b < kinds_and_big_hulls; ++b) {
      Row deep, hit;
      for (std::uint64_t seed = 1; seed <= pairs; ++seed) {
        const PosedPair pair = symmetric_pair(a, b, seed, 1, most_ratio);
        deep.time([&] { return penetration(pair.a, pair.pose_a, pair.b, pair.pose_b); });
        hit.time([&] { return intersect(pair.a, pair.pose_a, pair.b, pair.pose_b); });
      }
      deep.print(kind_names[a], kind_names[b], "penetration");
      hit.print(kind_names[a], kind_names[b], "intersect");
    }
}

}  // namespace
}  // namespace boxstream::ccd_test

int main(int arguments, char** argument) {
  const int pairs = arguments > 1 ? std::atoi(argument[1]) : 210;
  const double most_ratio = arguments > 2 ? std::atof(argument[2]) : 1;
  if (pairs < 1 || !(most_ratio >= 1))
    return std::fprintf(stderr, "boxstream_ccd_times [pairs of each kind [largest ratio of the sizes]]\n"), 2;
  boxstream::ccd_test::run(static_cast<std::uint64_t>(pairs), most_ratio);
}
