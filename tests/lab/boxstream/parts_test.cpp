// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "base/sorted_sweep.hpp"
#include "base/words.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/simulate/summary.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool {
namespace {

using tool_test::ScratchDirectory;

TEST(ToolParts, FirstDifferenceNamesTheLeastPairAndItsOwner) {
  const std::vector<Pair> base{{1, 2}, {1, 5}, {3, 4}};
  EXPECT_FALSE(first_difference(base, base));
  EXPECT_FALSE(first_difference({}, {}));
  const auto check = [&](const std::vector<Pair>& other, Pair pair, bool in_first) {
    const auto found = first_difference(base, other);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->pair, pair);
    EXPECT_EQ(found->in_first, in_first);
    const auto mirrored = first_difference(other, base);
    ASSERT_TRUE(mirrored);
    EXPECT_EQ(mirrored->pair, pair);
    EXPECT_EQ(mirrored->in_first, !in_first);
  };
  check({}, {1, 2}, true);
  check({{1, 5}, {3, 4}}, {1, 2}, true);
  check({{1, 2}, {1, 5}}, {3, 4}, true);
  check({{1, 2}, {1, 3}, {1, 5}, {3, 4}}, {1, 3}, false);
  check({{1, 2}, {1, 5}, {3, 4}, {3, 9}}, {3, 9}, false);
  check({{1, 2}, {1, 5}, {1, 5}, {3, 4}}, {1, 5}, false);
}

TEST(ToolParts, MedianMinAndTotal) {
  EXPECT_EQ(summarize({}).median_ms, 0);
  const Times odd = summarize({5, 1, 3});
  EXPECT_EQ(odd.median_ms, 3);
  EXPECT_EQ(odd.min_ms, 1);
  EXPECT_EQ(odd.total_ms, 9);
  EXPECT_EQ(summarize({4, 1, 2, 3}).median_ms, 2.5);
}

TEST(ToolParts, GroupedDigits) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1 000");
  EXPECT_EQ(grouped(1234567), "1 234 567");
}

TEST(ToolParts, HelpHasOnlyWhatIsThere) {
  const std::string whole = main_help({}), part = main_help({"replay", "pairs"});
  for (const char* const words : {"boxstream replay", "boxstream pairs"}) {
    EXPECT_NE(whole.find(words), std::string::npos) << words;
    EXPECT_EQ(part.find(words), std::string::npos) << words;
  }
  EXPECT_NE(part.find("boxstream query"), std::string::npos);
  EXPECT_EQ(whole.find("./dev build"), std::string::npos);
  EXPECT_NE(part.find("./dev build"), std::string::npos);
}

TEST(ToolParts, MissingCommandsAreAnsweredWithTheBuildThatHasThem) {
  const std::vector<std::string> commands{"simulate", "list"}, missing{"replay", "man"};
  EXPECT_EQ(unknown_command("replay", commands, missing), "this build has no command 'replay': ./dev build makes it");
  EXPECT_EQ(unknown_command("repaly", commands, missing), "unknown command 'repaly'; did you mean 'replay'?");
  EXPECT_EQ(unknown_command("listen", commands, missing), "unknown command 'listen'; did you mean 'list'?");
  EXPECT_EQ(unknown_command("quaternion", commands, missing), "unknown command 'quaternion'; there are simulate, list");
}

TEST(ToolParts, NearestNameIsTheOneMeant) {
  const std::vector<std::string> names{"simulate", "replay", "pairs", "paper", "list"};
  EXPECT_EQ(did_you_mean("simulat", names), "; did you mean 'simulate'?");
  EXPECT_EQ(did_you_mean("sim", names), "; did you mean 'simulate'?");
  EXPECT_EQ(did_you_mean("pairz", names), "; did you mean 'pairs'?");
  EXPECT_EQ(did_you_mean("repaly", names), "; did you mean 'replay'?");
  EXPECT_EQ(did_you_mean("quaternion", names), "");
  EXPECT_EQ(did_you_mean("", names), "");
  EXPECT_EQ(did_you_mean(std::string(100'000, 'a'), names), "");
  EXPECT_EQ(did_you_mean("list", {}), "");
  EXPECT_EQ(did_you_mean("!=", {"<=", "=="}), "");
}

}  // namespace
}  // namespace boxstream::tool
