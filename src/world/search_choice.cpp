// SPDX-License-Identifier: MIT
#include "world/search_choice.hpp"

#include <algorithm>

#include "base/thresholds.hpp"

namespace boxstream::detail {

namespace {

prices::Price price_of_rebuild(const SearchState& state) {
  return prices::rebuild(state.boxes, state.pairs, state.candidates.candidates);
}

prices::Price price_of_pass(const SearchState& state) {
  return prices::pass(state.dirty, state.candidates.compared) + prices::exits(state.candidates);
}

}  // namespace

SearchChoice::Choice SearchChoice::choose(const SearchState& state) {
  if (state.dirty == 0) return {};
  if (state.is_few) {
    Choice choice;
    choice.mode = choose_of_few(state.boxes, state.dirty, state.pairs).mode;
    const Answer answer = candidates_pay(state, price_of_few(state.boxes, state.dirty, state.pairs));
    if (answer == Answer::yes) choice.mode = SearchMode::candidates;
    choice.gives_up = answer == Answer::never;
    return choice;
  }
  const prices::Price all = prices::all(state.boxes), probe = prices::probe(state.boxes, state.dirty);
  const prices::Price pairs_of_dirty = prices::pairs(state.pairs * state.dirty / state.boxes);
  const prices::Price otherwise = std::min(probe / state.threads + pairs_of_dirty,
                                           all / state.threads + prices::pairs_of_batch(state.boxes, state.pairs));
  Choice choice;
  if (const Answer answer = candidates_pay(state, otherwise); answer == Answer::yes) {
    choice.mode = SearchMode::candidates;
    return choice;
  } else {
    choice.gives_up = answer == Answer::never;
  }
  const prices::Price beside = prices::beside(state.boxes, state.dirty);
  choice.mode = beside < all && probe < all ? SearchMode::beside : SearchMode::all;
  if (probe >= std::min(all, beside)) return choice;
  choice.worth_of_index = std::min(all, beside) - probe;
  if (!state.has_index) return choice;
  choice.mode = SearchMode::probe;
  // One that is worn still serves while boxes come that take as long as building the next one.
  choice.worth_of_index = state.index_is_worn ? choice.worth_of_index / 2 : 0;
  return choice;
}

SearchChoice::Answer SearchChoice::candidates_pay(const SearchState& state, prices::Price otherwise) {
  const CandidateState& candidates = state.candidates;
  if (!candidates.are_kept) {
    if (wait_ > 0) {
      --wait_;
      return Answer::no;
    }
    if (state.planned + state.planned / 8 >= otherwise) return Answer::no;
    gained_ = 0;
    return Answer::yes;
  }
  const bool rebuild = is_rebuild(state);
  const prices::Price price = rebuild ? price_of_rebuild(state) : price_of_pass(state);
  const std::int64_t gain = static_cast<std::int64_t>(otherwise) - static_cast<std::int64_t>(price);
  if (rebuild) {
    if (gained_ + gain <= 0) {
      gives_up();
      return Answer::never;
    }
    failures_ = 0;
    gained_ = 0;
    return Answer::yes;
  }
  if (gain < 0 && 8 * state.dirty < state.boxes) return Answer::no;
  gained_ += gain;
  return Answer::yes;
}

bool SearchChoice::is_rebuild(const SearchState& state) const {
  if (!state.candidates.are_kept) return true;
  const prices::Price exits = prices::exits(state.candidates), full = price_of_rebuild(state);
  return spent_on_exits_ + exits > full || (4 * exits > full && price_of_pass(state) * updates_ > spent_);
}

void SearchChoice::rebuilds(const SearchState& state) {
  spent_ = price_of_rebuild(state);
  spent_on_exits_ = 0;
  updates_ = 1;
}

void SearchChoice::passes(const SearchState& state) {
  spent_ += price_of_pass(state);
  spent_on_exits_ += prices::exits(state.candidates);
  ++updates_;
}

void SearchChoice::gives_up() {
  wait_ = thresholds.first_wait << 2 * failures_;
  failures_ = std::min(failures_ + 1, thresholds.most_failures);
}

}  // namespace boxstream::detail
