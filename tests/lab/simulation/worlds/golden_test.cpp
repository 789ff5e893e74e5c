// SPDX-License-Identifier: MIT
// What worlds do, step for step, is what they did when golden.txt was written.
#include <LinearMath/btScalar.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "golden.hpp"
#include "source_path.hpp"

namespace boxstream::worlds_test {
namespace {

struct Recorded {
  std::string line, name, precision;
};

std::vector<Recorded> recorded() {
  const std::string path = tests::source_path("tests/lab/simulation/worlds/golden.txt");
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::vector<Recorded> all;
  for (std::string line; std::getline(file, line);) {
    Recorded one{line, {}, {}};
    std::istringstream(line) >> one.name >> one.precision;
    if (!line.empty() && line[0] != '#') all.push_back(one);
  }
  return all;
}

constexpr const char* this_precision = sizeof(btScalar) == 8 ? "double" : "float";

bool is_world(const std::string& name) {
  return name.rfind("world/", 0) == 0;
}

TEST(Golden, HasALineForEachAndNoOthers) {
  std::vector<std::string> names, listed;
  for (const std::string& name : golden_names()) names.push_back(name);
  for (const Recorded& one : recorded())
    if (one.precision == this_precision && is_world(one.name) == is_world(names.front())) listed.push_back(one.name);
  std::sort(names.begin(), names.end());
  std::sort(listed.begin(), listed.end());
  EXPECT_EQ(listed, names);
}

class GoldenRun : public testing::TestWithParam<std::string> {};

TEST_P(GoldenRun, IsAsRecorded) {
#if !defined(__x86_64__) || !defined(__GLIBC__)
  GTEST_SKIP() << "recorded on x86-64 with glibc: others round sines differently";
#endif
  if (btGetVersion() != 324) GTEST_SKIP() << "recorded with Bullet 3.24 as Debian 12 builds it";
  const std::string now = golden_line(GetParam());
  for (const Recorded& one : recorded())
    if (one.name == GetParam() && one.precision == this_precision) {
      EXPECT_EQ(now, one.line)
          << "if this was changed on purpose: python3 tests/lab/simulation/worlds/golden.py build/release";
      return;
    }
  FAIL() << "not recorded: " << now;
}

INSTANTIATE_TEST_SUITE_P(All, GoldenRun, testing::ValuesIn(golden_names()), [](const auto& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
});

}  // namespace
}  // namespace boxstream::worlds_test
