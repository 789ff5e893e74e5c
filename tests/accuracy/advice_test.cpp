// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "accuracy/advice.hpp"

namespace boxstream::accuracy_test {
namespace {

using namespace accuracy;

/// Eight links of 1 kg hang straight down, with `load` kg at their end.
nlohmann::json chain(double load) {
  auto scene = nlohmann::json::parse(R"({
    "format": 1, "meta": {"name": "chain", "about": "a chain bears a load", "source": "own"},
    "time": {"dt": 0.016666666666666666, "steps": 120},
    "world": {"bounds": {"min": [-9, -19, -9], "max": [9, 9, 9]}},
    "shapes": [{"name": "link", "type": "capsule", "radius": 0.1, "height": 0.2},
               {"name": "load", "type": "sphere", "radius": 0.5}],
    "generators": [{"type": "chain", "links": 8, "anchor": [0, 0, 0], "direction": [0, -1, 0], "pitch": 0.5,
                    "end_offset": 0.5, "link": {"shape": "link", "mass": 1, "sleep": false},
                    "end": {"shape": "load", "sleep": false}}]
  })");
  scene["generators"][0]["end"]["mass"] = load;
  return scene;
}

/// One row for each cost, of which the first is the scene as it is; those with a reason are not sound.
Advice among(const std::vector<std::pair<double, std::string>>& rows) {
  Request request;
  request.knobs = {parse_knob("substeps=1,2,4,8")};
  request.measures = {parse_measure("penetration")};
  Sweep sweep;
  for (const auto& [ms, reason] : rows) {
    Row row;
    row.setting = {1 << sweep.rows.size()};
    row.ms = {ms, ms - 0.1, ms + 0.1, ms};
    row.series = {{}};
    row.unsound = reason;
    sweep.rows.push_back(row);
  }
  sweep.own = 0;
  return advice_of(request, sweep, 0, HUGE_VAL);
}

TEST(Advice, IsTheCheapestSoundSettingAndItsPrice) {
  const Advice advice = among({{2, "breaks"}, {1, "gains energy"}, {4, ""}, {6, ""}});
  EXPECT_EQ(advice.best, 2u);
  ASSERT_TRUE(advice.price);
  EXPECT_DOUBLE_EQ(advice.price->value, 2);
  EXPECT_DOUBLE_EQ(advice.price->low, 3.9 / 2.1);
  EXPECT_DOUBLE_EQ(advice.price->high, 4.1 / 1.9);
}

TEST(Advice, IsTheSceneAsItIsWhereNothingElseIsCheaper) {
  EXPECT_TRUE(among({{2, ""}, {2.1, ""}}).is_scene_as_it_is());
  EXPECT_TRUE(among({{2, ""}, {1.9, ""}}).is_scene_as_it_is());
  EXPECT_FALSE(among({{2, ""}, {1, ""}}).is_scene_as_it_is());
  EXPECT_FALSE(among({{2, "breaks"}, {3, "breaks"}}).best);
}

TEST(Advice, IsAnotherSettingWhereTheSceneAsItIsGivesWay) {
  Request request = advice_request(chain(3000), "chain.json", 20);
  request.repeats = 3;
  const Advice advice = advise(request, [](const Stage&) {});
  ASSERT_NE(advice.own_row(), nullptr);
  EXPECT_NE(advice.own_row()->unsound, "");
  ASSERT_TRUE(advice.best);
  EXPECT_FALSE(advice.is_scene_as_it_is());
  EXPECT_TRUE(advice.best_row()->may_be_advised());
  ASSERT_TRUE(advice.price);
  EXPECT_LE(advice.price->low, advice.price->value);
  EXPECT_LE(advice.price->value, advice.price->high);
  for (const Row& row : advice.sweep.rows)
    EXPECT_TRUE(!row.may_be_advised() || row.ms.high >= advice.best_row()->ms.low) << row.label;
}

}  // namespace
}  // namespace boxstream::accuracy_test
