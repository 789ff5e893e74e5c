// SPDX-License-Identifier: MIT
#include "pictures/viewer/page.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "mixed.hpp"
#include "pictures/viewer/text.hpp"

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
  const std::size_t fit = Recording::Options().size / frame;
  EXPECT_EQ(Recording(simulation, {fit}).every(), 1U);
  EXPECT_EQ(Recording(simulation, {fit + 1}).every(), 2U);
  EXPECT_EQ(Recording(simulation, {10 * fit}).every(), 10U);
  EXPECT_EQ(Recording(simulation, {10 * fit, 3}).every(), 3U);
}

/// A page of the mixed scene, or of that many worlds of it side by side.
std::string page_of(int steps, std::size_t count) {
  std::vector<std::unique_ptr<scenes::Simulation>> simulations;
  std::vector<std::unique_ptr<Recording>> recordings;
  std::vector<std::vector<scenes::StepResult>> results(count);
  std::vector<PageWorld> worlds;
  for (std::size_t w = 0; w < count; ++w) {
    simulations.push_back(std::make_unique<scenes::Simulation>(view_test::mixed_scene(), "boxstream"));
    recordings.push_back(
        std::make_unique<Recording>(*simulations.back(), Recording::Options{static_cast<std::uint64_t>(steps), 1}));
    for (int i = 0; i < steps; ++i) {
      results[w].push_back(simulations.back()->step());
      recordings.back()->add_step();
    }
    recordings.back()->finish();
    worlds.push_back({recordings.back().get(), "world", &results[w]});
  }
  std::ostringstream out;
  write_page(out, worlds, "test");
  return out.str();
}

TEST(Page, IsOneFileThatNamesNoOther) {
  if (!has_pages()) GTEST_SKIP() << "the viewer was not built in";
  const std::string html = page_of(80, 1);
  // 81 frames make two blocks.
  EXPECT_NE(html.find("id=\"frames-0-1\""), std::string::npos);
  EXPECT_EQ(html.find("id=\"frames-0-2\""), std::string::npos);
  EXPECT_EQ(html.find("id=\"world-1\""), std::string::npos);
  EXPECT_EQ(html.find("<script src"), std::string::npos);
  EXPECT_EQ(html.find("<link rel=\"stylesheet"), std::string::npos);
  EXPECT_EQ(html.find("@import"), std::string::npos);
  EXPECT_EQ(html.find("<!--run-->"), std::string::npos);
  EXPECT_NE(html.find("Three.js Authors"), std::string::npos) << "its licence asks for this";
  EXPECT_NE(html.find("Apache License"), std::string::npos) << "that of ECharts too";
  EXPECT_LT(html.size(), 2'000'000U);
}

TEST(Page, HasTwoWorldsSideBySide) {
  if (!has_pages()) GTEST_SKIP() << "the viewer was not built in";
  const std::string html = page_of(3, 2);
  for (const char* const id : {"world-0", "world-1", "frames-0-0", "frames-1-0"})
    EXPECT_NE(html.find("id=\"" + std::string(id) + "\""), std::string::npos) << id;
}

}  // namespace
}  // namespace boxstream::view
