// SPDX-License-Identifier: MIT
// More pairs than there is memory for.
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "sanitized.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

/// As ulimit does it, counted from what is in use.
void allow_more_memory(rlim_t bytes) {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t most = pages * 4096 + bytes;
  const rlimit limit{most, most};
  setrlimit(RLIMIT_AS, &limit);
}

void all_at_one_point(int n) {
  Rig rig;
  for (int i = 0; i < n; ++i) rig.create(cube(0, 0, 0));
  rig.calculate();
  std::exit(rig.pair_count() == n * (n - 1) / 2 ? 0 : 1);
}

TEST(BulletTooManyPairsDeathTest, MorePairsThanMemoryEndsWithOneClearLine) {
  if (boxstream::tests::sanitized) GTEST_SKIP() << "sanitizers take more addresses than any limit leaves";
  // Eighteen million pairs are half a gigabyte in Bullet's array alone.
  for (const rlim_t megabytes : {100, 300, 500})
    EXPECT_EXIT((allow_more_memory(megabytes << 20), all_at_one_point(6000)), testing::KilledBySignal(SIGABRT),
                "^boxstream::bullet: out of memory\n$")
        << megabytes;
  EXPECT_EXIT((allow_more_memory(300 << 20), all_at_one_point(1000)), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace boxstream::bullet_test
