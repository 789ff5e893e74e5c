// SPDX-License-Identifier: MIT
#include "measure/other_load.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <thread>
#include <vector>

#include "measure/clock.hpp"

namespace boxstream::measure_test {
namespace {

using namespace measure;

void work(double seconds) {
  const Elapsed elapsed;
  while (elapsed.seconds() < seconds) {
  }
}

TEST(OtherLoad, WorkOfThisProcessIsNoneOfOthers) {
  const auto processors = static_cast<unsigned>(sysconf(_SC_NPROCESSORS_ONLN));
  double least = processors;
  // Tests run beside each other, so the least of some tries.
  for (int attempt = 0; attempt < 5; ++attempt) {
    const OtherLoad load;
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < processors; ++i) threads.emplace_back(work, 0.3);
    for (std::thread& thread : threads) thread.join();
    least = std::min(least, load.processors());
  }
  EXPECT_GE(least, 0);
  EXPECT_LT(least, 0.7 * processors) << "all of them were kept busy by this process";
}

TEST(OtherLoad, WorkOfAnotherProcessIsSeen) {
  const OtherLoad load;
  const pid_t child = fork();
  if (child == 0) {
    work(30);
    _exit(0);
  }
  usleep(500000);
  const double others = load.processors();
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_GT(others, 0.3);
}

}  // namespace
}  // namespace boxstream::measure_test
