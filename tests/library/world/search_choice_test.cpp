// SPDX-License-Identifier: MIT
// Which search an update chooses, update by update: by prices and by what the updates before it have cost.
#include "world/search_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/thresholds.hpp"

namespace boxstream::detail {
namespace {

constexpr prices::Price never = ~prices::Price{0} / 2;

SearchState of(std::size_t boxes, std::size_t dirty, bool has_index = true) {
  SearchState state;
  state.boxes = boxes;
  state.dirty = dirty;
  state.has_index = has_index;
  state.planned = never;
  return state;
}

/// 8000 boxes that have candidates, of which `exits` have left their fat boxes. A rebuild is 11000, a pass 1800.
SearchState kept(std::size_t dirty, std::size_t exits = 0) {
  SearchState state = of(8000, dirty);
  state.pairs = 0;
  state.candidates.are_kept = true;
  state.candidates.fat_boxes = 8000;
  state.candidates.candidates = 4000;
  state.candidates.compared = 4000;
  state.candidates.exits = exits;
  return state;
}

TEST(SearchPrices, AreThoseOfTheList) {
  EXPECT_EQ(prices::all(1000), 1000u);
  EXPECT_EQ(prices::probe(1000, 10), 20u);
  EXPECT_EQ(prices::beside(1000, 5), 104u);
  EXPECT_EQ(prices::beside(1000, 100), 900u);
  EXPECT_EQ(prices::pass(100, 900), 100u);
  EXPECT_GT(prices::pass(thresholds.in_near_caches, 0), prices::pass(thresholds.in_near_caches - 1, 0));
  EXPECT_EQ(prices::rebuild(1000, 0, 400), 1350u);
  EXPECT_EQ(prices::exits(kept(8000).candidates), 0u);
  EXPECT_EQ(prices::exits(kept(8000, 2).candidates), 400u + 2 * 200);
  CandidateState many = kept(8000, thresholds.most_scans + 1).candidates;
  const prices::Price without = prices::exits(many);
  many.is_indexed = true;
  EXPECT_EQ(without - prices::exits(many), 3u * 8000);
}

TEST(SearchPrices, OfFewBoxes) {
  EXPECT_EQ(prices::rows(68), 68u);
  EXPECT_EQ(prices::dirty_rows(93, 7), 14u);
}

TEST(SearchChoice, FewAreComparedByRowsOrInABatch) {
  const auto mode = [](std::size_t boxes, std::size_t dirty, std::size_t pairs) {
    return SearchChoice::choose_of_few(boxes, dirty, pairs).mode;
  };
  EXPECT_EQ(mode(2, 1, 0), SearchMode::dirty_rows);
  EXPECT_EQ(mode(30, 15, 0), SearchMode::dirty_rows);
  EXPECT_EQ(mode(30, 30, 0), SearchMode::rows);
  EXPECT_EQ(mode(100, 100, 0), SearchMode::all);
  EXPECT_EQ(mode(100, 100, 200), SearchMode::rows) << "rows take no longer for pairs";
  EXPECT_EQ(mode(300, 15, 0), SearchMode::dirty_rows);
  EXPECT_EQ(mode(300, 300, 0), SearchMode::all);
  const std::size_t least = 2 * thresholds.cheap_of_few;  // of which each takes half as long as one of many
  EXPECT_TRUE(SearchChoice::choose_of_few(least - 1, least - 1, 0).is_final);
  EXPECT_FALSE(SearchChoice::choose_of_few(least, least, 0).is_final);
}

TEST(SearchChoice, ManyOfFewMayKeepCandidates) {
  SearchState state = of(200, 200);
  state.is_few = true;
  EXPECT_EQ(SearchChoice().choose(state).mode, SearchMode::all);
  state.has_index = true;  // which is of no use to them
  state.dirty = 20;
  EXPECT_EQ(SearchChoice().choose(state).mode, SearchMode::dirty_rows);
  EXPECT_EQ(SearchChoice().choose(state).worth_of_index, 0u);
  state.dirty = 200;
  for (const prices::Price planned : {88u, 89u}) {
    state.planned = planned;
    EXPECT_EQ(SearchChoice().choose(state).mode, planned < 89 ? SearchMode::candidates : SearchMode::all);
  }
}

TEST(SearchChoice, RoomsThatDoNotLastAreTriedLessAndLessOften) {
  SearchChoice choice;
  EXPECT_TRUE(choice.tries_rooms());
  unsigned expected = 2;
  for (int failure = 0; failure < 12; ++failure, expected = std::min(2 * expected, 1024u)) {
    choice.rooms_lasted(failure % 2 == 0 ? 0 : thresholds.rooms_pay - 1);
    unsigned waited = 0;
    while (!choice.tries_rooms()) ++waited;
    EXPECT_EQ(waited, expected);
  }
  choice.rooms_lasted(thresholds.rooms_pay);
  EXPECT_TRUE(choice.tries_rooms());
}

TEST(SearchChoice, NothingDirtyIsNoSearch) {
  EXPECT_EQ(SearchChoice().choose(of(1000, 0)).mode, SearchMode::none);
}

TEST(SearchChoice, FewAskTheIndexAndManyAreABatch) {
  SearchChoice choice;
  EXPECT_EQ(choice.choose(of(10000, 10)).mode, SearchMode::probe);
  EXPECT_EQ(choice.choose(of(10000, 3000)).mode, SearchMode::probe);
  EXPECT_EQ(choice.choose(of(10000, 4000)).mode, SearchMode::all);
  EXPECT_EQ(choice.choose(of(10000, 10000)).mode, SearchMode::all);
}

TEST(SearchChoice, AnIndexIsWorthWhatAProbeWouldHaveSaved) {
  SearchChoice choice;
  const auto few = choice.choose(of(10000, 10, false));
  EXPECT_EQ(few.mode, SearchMode::beside);
  EXPECT_EQ(few.worth_of_index, prices::beside(10000, 10) - prices::probe(10000, 10));
  const auto some = choice.choose(of(10000, 1000, false));
  EXPECT_EQ(some.mode, SearchMode::beside);
  EXPECT_EQ(some.worth_of_index, prices::beside(10000, 1000) - prices::probe(10000, 1000));
  const auto more = choice.choose(of(10000, 2000, false));
  EXPECT_EQ(more.mode, SearchMode::all);
  EXPECT_EQ(more.worth_of_index, 10000 - prices::probe(10000, 2000));
  const auto all = choice.choose(of(10000, 10000, false));
  EXPECT_EQ(all.mode, SearchMode::all);
  EXPECT_EQ(all.worth_of_index, 0u);
}

TEST(SearchChoice, CandidatesAreTriedWhereTheyAreExpectedToPay) {
  SearchState state = of(8000, 8000);
  for (const prices::Price planned : {7000u, 7112u}) {
    state.planned = planned;
    EXPECT_EQ(SearchChoice().choose(state).mode, planned < 7111 ? SearchMode::candidates : SearchMode::all);
  }
  state.planned = 7000;
  state.threads = 4;  // on which a batch takes a fourth
  EXPECT_EQ(SearchChoice().choose(state).mode, SearchMode::all);
  state.pairs = 100000;  // which a batch would have to look up
  EXPECT_EQ(SearchChoice().choose(state).mode, SearchMode::candidates);
}

TEST(SearchChoice, WhereFewMoveCandidatesRestUntilTheyPayAgain) {
  SearchChoice choice;
  choice.rebuilds(kept(8000));
  EXPECT_EQ(choice.choose(kept(8000)).mode, SearchMode::candidates);
  const auto few = choice.choose(kept(10));
  EXPECT_EQ(few.mode, SearchMode::probe);
  EXPECT_FALSE(few.gives_up);
  EXPECT_EQ(choice.choose(kept(8000)).mode, SearchMode::candidates);
}

TEST(SearchChoice, ExitsThatHaveCostARebuildLeadToOne) {
  SearchChoice choice;
  EXPECT_TRUE(choice.is_rebuild(of(8000, 8000)));
  choice.rebuilds(kept(8000));
  unsigned updates = 0;
  for (; updates < 100 && !choice.is_rebuild(kept(8000, 10)); ++updates) choice.passes(kept(8000, 10));
  EXPECT_EQ(updates, 4u);  // of 2400 each
  choice.rebuilds(kept(8000));
  EXPECT_FALSE(choice.is_rebuild(kept(8000, 10)));
  for (int i = 0; i < 10; ++i) choice.passes(kept(8000));
  EXPECT_TRUE(choice.is_rebuild(kept(8000, 40)));  // at once: they would raise the average
}

TEST(SearchChoice, CandidatesThatHaveNotPaidAreGivenUpForLongerEachTime) {
  SearchChoice choice;
  SearchState hopeful = of(8000, 8000);
  hopeful.planned = 1;
  unsigned expected = thresholds.first_wait;
  for (unsigned failures = 0; failures < thresholds.most_failures + 2; ++failures) {
    ASSERT_EQ(choice.choose(hopeful).mode, SearchMode::candidates);
    choice.rebuilds(kept(8000));
    const auto answer = choice.choose(kept(8000, 64));
    ASSERT_TRUE(answer.gives_up) << failures;
    EXPECT_EQ(answer.mode, SearchMode::all);
    unsigned waited = 0;
    while (waited < 100000 && choice.choose(hopeful).mode != SearchMode::candidates) ++waited;
    EXPECT_EQ(waited, expected);
    if (failures < thresholds.most_failures) expected *= 4;
  }
  // Having paid, they are trusted again.
  choice.rebuilds(kept(8000));
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(choice.choose(kept(8000)).mode, SearchMode::candidates);
    choice.passes(kept(8000));
  }
  EXPECT_EQ(choice.choose(kept(8000, 64)).mode, SearchMode::candidates);
  choice.gives_up();
  unsigned waited = 0;
  while (waited < 100000 && choice.choose(hopeful).mode != SearchMode::candidates) ++waited;
  EXPECT_EQ(waited, thresholds.first_wait);
}

}  // namespace
}  // namespace boxstream::detail
