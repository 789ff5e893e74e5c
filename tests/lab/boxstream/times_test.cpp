// SPDX-License-Identifier: MIT
// Times and progress on a machine that has other things to do.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>

#include "process.hpp"
#include "sanitized.hpp"

namespace boxstream::tool_test {
namespace {

using nlohmann::json;

/// This process and its children share one processor with three programs that want it all the time.
class BusyProcessor {
 public:
  BusyProcessor() {
    sched_getaffinity(0, sizeof all_, &all_);
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
      if (CPU_ISSET(cpu, &all_)) CPU_SET(cpu, &one);
    sched_setaffinity(0, sizeof one, &one);
    for (pid_t& child : children_) {
      child = fork();
      if (child != 0) continue;
      for (std::atomic<unsigned> spin{0};;) ++spin;
    }
  }
  ~BusyProcessor() {
    for (const pid_t child : children_) {
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
    }
    sched_setaffinity(0, sizeof all_, &all_);
  }
  BusyProcessor(const BusyProcessor&) = delete;
  BusyProcessor& operator=(const BusyProcessor&) = delete;

 private:
  cpu_set_t all_;
  pid_t children_[3];
};

std::vector<std::string> lines_with(const std::string& text, const std::string& part) {
  std::vector<std::string> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.find(part) != std::string::npos) found.push_back(line);
  return found;
}

TEST(Times, AreProcessorTimeAndABusyMachineIsNamed) {
  if (tests::sanitized) GTEST_SKIP() << "times are those without sanitizers";
  const std::vector<std::string> arguments{"simulate", "wall", "--steps", "60", "--json", "-"};
  Outcome run;
  {
    const BusyProcessor busy;
    run = run_tool(arguments);
  }
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(lines_with(run.err, "boxstream: the machine was busy: ").size(), 1u) << run.err;
  const json world = json::parse(run.out).at("worlds").at(0);
  EXPECT_EQ(world.at("clock"), "cpu");
  double lost = 0;
  for (const json& step : world.at("steps")) lost += step.at("lost_ms").get<double>();
  // Three others take three quarters of the time, which a clock on the wall would count.
  const double total = world.at("summary").at("step").at("total_ms");
  EXPECT_GT(lost, total) << "of " << total;
  EXPECT_NEAR(world.at("summary").at("sum").at("total_ms").get<double>(),
              world.at("summary").at("broadphase").at("total_ms").get<double>() +
                  world.at("summary").at("dispatch").at("total_ms").get<double>(),
              1e-6 * total);
}

TEST(Times, OfThreadsAreElapsedTime) {
  const Outcome table = run_tool({"simulate", "wall", "--steps", "2"});
  EXPECT_EQ(lines_with(table.out, "times         processor time of one thread").size(), 1u) << table.out;
  const Outcome threads = run_tool({"simulate", "effects/threads", "--steps", "2"});
  EXPECT_EQ(lines_with(threads.out, "times         elapsed time").size(), 1u) << threads.out << threads.err;
}

TEST(Progress, OneLineForEachTenthWithoutATerminal) {
  if (tests::sanitized) GTEST_SKIP() << "takes long under a sanitizer";
  const Outcome run = run_tool({"simulate", "pile", "--steps", "200"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<std::string> lines = lines_with(run.err, "boxstream: step ");
  EXPECT_GE(lines.size(), 1u) << run.err;
  EXPECT_LE(lines.size(), 10u);
  int last = 0;
  for (const std::string& line : lines) {
    const int step = std::stoi(line.substr(std::string("boxstream: step ").size()));
    EXPECT_GT(step * 10 / 200, last) << line;
    last = step * 10 / 200;
    EXPECT_NE(line.find("left"), std::string::npos);
  }
  EXPECT_EQ(last, 10);
  EXPECT_EQ(run.err.find('\r'), std::string::npos);
}

}  // namespace
}  // namespace boxstream::tool_test
