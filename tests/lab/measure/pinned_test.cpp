// SPDX-License-Identifier: MIT
#include "measure/pinned.hpp"

#include <gtest/gtest.h>

namespace boxstream::measure_test {
namespace {

cpu_set_t allowed() {
  cpu_set_t set;
  CPU_ZERO(&set);
  sched_getaffinity(0, sizeof set, &set);
  return set;
}

TEST(Pinned, OneProcessorOfThoseBeforeAndAllAgainAfterwards) {
  const cpu_set_t before = allowed();
  {
    const measure::Pinned pinned;
    const cpu_set_t during = allowed();
    EXPECT_EQ(CPU_COUNT(&during), 1);
    cpu_set_t both;
    CPU_AND(&both, &before, &during);
    EXPECT_TRUE(CPU_EQUAL(&both, &during));
  }
  const cpu_set_t after = allowed();
  EXPECT_TRUE(CPU_EQUAL(&before, &after));
}

}  // namespace
}  // namespace boxstream::measure_test
