// SPDX-License-Identifier: MIT
#include "measure/machine.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <ctime>
#include <thread>
#include <vector>

#include "measure/stopwatch.hpp"

namespace boxstream::measure_test {
namespace {

using namespace measure;

void work(double seconds) {
  const Elapsed elapsed;
  while (elapsed.seconds() < seconds) {
  }
}

double own_seconds() {
  std::timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

TEST(OtherLoad, WorkOfThisProcessIsNoneOfOthers) {
  const auto processors = static_cast<unsigned>(sysconf(_SC_NPROCESSORS_ONLN));
  const double own = own_seconds();
  const Elapsed elapsed;
  const OtherLoad load;
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < processors; ++i) threads.emplace_back(work, 1);
  for (std::thread& thread : threads) thread.join();
  const double others = load.processors();
  EXPECT_GE(others, 0);
  // However busy others are, what this process took is left for none of them. Systems count in ticks of 10 ms.
  const double left = processors - (own_seconds() - own) / elapsed.seconds();
  EXPECT_LT(others, left + 0.15 * processors);
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
