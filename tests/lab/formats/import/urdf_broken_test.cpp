// SPDX-License-Identifier: MIT
// Files that are no robot.
#include <cstdint>

#include "urdf_robot.hpp"

namespace boxstream::import_test {
namespace {

TEST(BrokenUrdf, IsRefusedWithOneLine) {
  EXPECT_EQ(complaint("").substr(0, 7), "no URDF");
  EXPECT_EQ(complaint("<robot name=\"r\">").substr(0, 7), "no URDF");
  EXPECT_EQ(complaint("{\"format\": 1}").substr(0, 7), "no URDF");
  EXPECT_EQ(complaint(without(post_and_bar, "link=\"bar\"", "link=\"pub\"")).substr(0, 7), "no URDF");
  EXPECT_NE(complaint(without(post_and_bar, "value=\"2\"", "value=\"two\"")), "");
  EXPECT_NE(complaint(without(post_and_bar, "value=\"2\"", "value=\"nan\"")), "");
  EXPECT_NE(complaint(without(post_and_bar, "value=\"2\"", "value=\"1e999\"")), "");
  EXPECT_EQ(complaint(without(post_and_bar, "value=\"2\"", "value=\"-2\"")),
            "link \"bar\": a size that is not greater than 0");
  EXPECT_EQ(complaint(without(post_and_bar, "1 0.1 0.1", "1 0 0.1")),
            "link \"bar\": a size that is not greater than 0");
  EXPECT_EQ(complaint(without(post_and_bar, "lower=\"-0.5\"", "lower=\"2\"")),
            "joint \"hinge\": limits are not in ascending order");
}

TEST(BrokenUrdf, ALinkOfTwoJointsIsRefused) {
  for (const char* const parent : {"post", "bar"})
    EXPECT_EQ(complaint(without(post_and_bar, "</robot>",
                                "<joint name=\"second\" type=\"fixed\"><parent link=\"" + std::string(parent) +
                                    "\"/><child link=\"bar\"/></joint></robot>")),
              "link \"bar\" hangs on two joints, \"hinge\" and \"second\"");
}

TEST(BrokenUrdf, LinksInARingAreRefused) {
  const auto joint = [](const std::string& name, const std::string& parent, const std::string& child) {
    return "<link name=\"" + child + "\"/><joint name=\"" + name + "\" type=\"fixed\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/></joint>";
  };
  EXPECT_EQ(complaint(without(post_and_bar, "</robot>",
                              joint("to", "tail", "head") + joint("fro", "head", "tail") + "</robot>")),
            "link \"head\" does not hang on the root link \"post\"");
}

TEST(BrokenUrdf, NestedWithoutEndIsRefused) {
  std::string deep = "<robot name=\"r\">";
  for (int i = 0; i < 5'000; ++i) deep += "<a>";
  EXPECT_NE(complaint(deep), "");
}

TEST(BrokenUrdf, NeverBringsTheProgramDown) {
  const std::string good = post_and_bar;
  std::uint64_t state = 7;
  const auto random = [&](std::size_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::size_t>((state >> 33) % below);
  };
  for (int round = 0; round < 40; ++round) {
    std::string bad = good;
    for (int i = 0; i < 3; ++i) bad[random(bad.size())] = static_cast<char>(random(256));
    if (round % 4 == 0) bad.resize(random(bad.size()));
    complaint(bad);  // one line, or none
  }
}

}  // namespace
}  // namespace boxstream::import_test
