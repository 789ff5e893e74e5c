// SPDX-License-Identifier: MIT
// Random histories of a World against the plain model, whatever way the updates search.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <iterator>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "player.hpp"
#include "watched_world.hpp"

namespace boxstream::tests {

rc::Gen<std::vector<Op>> histories() {
  const auto kind = rc::gen::weightedElement<Kind>(
      {{4, Kind::create},      {4, Kind::create_many},     {4, Kind::destroy},   {2, Kind::destroy_many},
       {6, Kind::move},        {4, Kind::move_many},       {3, Kind::move_all},  {1, Kind::move_nowhere},
       {4, Kind::bulk_create}, {3, Kind::bulk_destroy},    {6, Kind::bulk_move}, {6, Kind::filter},
       {10, Kind::update},     {8, Kind::update_refusing}, {5, Kind::release},   {5, Kind::begin_pairs},
       {5, Kind::query},       {3, Kind::nudge_few},       {2, Kind::distances}, {1, Kind::stale},
       {3, Kind::refilter},    {1, Kind::refilter_all},    {1, Kind::clear},     {2, Kind::shrink_to_fit}});
  return rc::gen::container<std::vector<Op>>(
      rc::gen::build<Op>(rc::gen::set(&Op::kind, kind), rc::gen::set(&Op::which, rc::gen::inRange(0u, 100000u)),
                         rc::gen::set(&Op::value, rc::gen::inRange(0u, 100000u))));
}

template <class S>
bool histories_agree(std::optional<detail::SearchMode> mode, bool sticky, unsigned grid) {
  return rc::check([=] {
    const auto ops = *histories();
    WorldOptions options;
    options.sticky_filters = sticky;
    detail::WorldCore<S> world(options, mode.value_or(detail::SearchMode::cheapest));
    Player<S, detail::WorldCore<S>> player(world, sticky, [grid](unsigned value) { return box_from<S>(value, grid); });
    for (const Op& op : ops) {
      if (!mode) world.force(search_modes[op.value % std::size(search_modes)]);
      player.play(op);
      RC_ASSERT(!::testing::Test::HasFailure());
    }
  });
}

/// Without a mode, updates search in turns in all of them.
using Case = std::tuple<std::optional<detail::SearchMode>, bool, unsigned>;

class OpStream : public ::testing::TestWithParam<Case> {};

TEST_P(OpStream, FloatWorldAgreesWithTheModel) {
  const auto [mode, sticky, grid] = GetParam();
  EXPECT_TRUE(histories_agree<float>(mode, sticky, grid));
}

TEST_P(OpStream, DoubleWorldAgreesWithTheModel) {
  const auto [mode, sticky, grid] = GetParam();
  EXPECT_TRUE(histories_agree<double>(mode, sticky, grid));
}

std::string case_name(const ::testing::TestParamInfo<Case>& test) {
  const auto [mode, sticky, grid] = test.param;
  const char* const modes[] = {"none", "probe", "all", "candidates", "cheapest", "beside"};
  return std::string(mode ? modes[int(*mode)] : "mixed") + (sticky ? "Sticky" : "Live") + "Grid" + std::to_string(grid);
}

INSTANTIATE_TEST_SUITE_P(World, OpStream,
                         ::testing::Combine(::testing::Values(detail::SearchMode::probe, detail::SearchMode::all,
                                                              detail::SearchMode::candidates,
                                                              detail::SearchMode::cheapest, detail::SearchMode::beside,
                                                              std::nullopt),
                                            ::testing::Bool(), ::testing::Values(8u, 40u)),
                         case_name);

}  // namespace boxstream::tests
