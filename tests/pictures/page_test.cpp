// SPDX-License-Identifier: MIT
#include "pictures/viewer/page.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "mixed.hpp"
#include "pictures/viewer/deflate.hpp"

namespace boxstream::view {
namespace {

TEST(Page, Base64) {
  // The test vectors of RFC 4648.
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : vectors) EXPECT_EQ(base64(plain), coded);
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Page, LeavesOutAsManyStepsAsItMust) {
  scenes::Simulation simulation(view_test::mixed_scene(), "boxstream");
  const std::size_t frame = expected_frame_size(simulation.objects().size(), 64);
  const std::size_t fit = Page::page_size / frame;
  EXPECT_EQ(Page(simulation, {fit, 0, ""}).every(), 1U);
  EXPECT_EQ(Page(simulation, {fit + 1, 0, ""}).every(), 2U);
  EXPECT_EQ(Page(simulation, {10 * fit, 0, ""}).every(), 10U);
  EXPECT_EQ(Page(simulation, {10 * fit, 3, ""}).every(), 3U);
}

TEST(Page, IsOneFileThatNamesNoOther) {
  if (!Page::is_available()) GTEST_SKIP() << "the viewer was not built in";
  scenes::Simulation simulation(view_test::mixed_scene(), "boxstream");
  Page page(simulation, {40, 2, "test"});
  std::vector<scenes::StepResult> results;
  for (int i = 0; i < 40; ++i) {
    results.push_back(simulation.step());
    page.add_step();
  }
  std::ostringstream out;
  page.write(out, results);
  const std::string html = out.str();
  // 21 frames make two blocks.
  EXPECT_NE(html.find("id=\"frames-1\""), std::string::npos);
  EXPECT_EQ(html.find("id=\"frames-2\""), std::string::npos);
  EXPECT_EQ(html.find("<script src"), std::string::npos);
  EXPECT_EQ(html.find("<link rel=\"stylesheet"), std::string::npos);
  EXPECT_EQ(html.find("@import"), std::string::npos);
  EXPECT_EQ(html.find("<!--run-->"), std::string::npos);
  EXPECT_NE(html.find("Three.js Authors"), std::string::npos) << "its licence asks for this";
  EXPECT_LT(html.size(), 2'000'000U);
}

}  // namespace
}  // namespace boxstream::view
