// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "world/state/search_prices.hpp"

namespace boxstream::detail {

/// How an update finds the pairs that may have begun. The outcome is the same for all.
enum class SearchMode {
  none,        ///< nothing is dirty: no search
  probe,       ///< all dirty proxies query the index
  all,         ///< one batch, all against all
  candidates,  ///< candidates kept from earlier updates
  cheapest,    ///< whichever of these costs least
  beside,      ///< one batch, the dirty proxies against all: while an index is not worth being made
};

/// What an update begins with, as far as prices depend on it.
struct SearchState {
  std::size_t boxes = 0, dirty = 0;
  std::size_t pairs = 0;    ///< held
  std::size_t threads = 1;  ///< of a batch, and of a probe
  bool has_index = false;   ///< that a probe can ask as it is
  CandidateState candidates;
  prices::Price planned = 0;  ///< with candidates, where there are none: see FatBoxes::planned_price
};

/// Chooses, update by update, what is expected to cost least, by the list of prices and by accounts of what the
/// updates so far have cost.
///
/// - An index is built bit by bit, by what probes would have saved: the total is at most twice that of the better
///   choice.
/// - Candidates are tried where they are expected to pay, made anew if they have paid since the last time, and given up
///   otherwise, for longer each time.
class SearchChoice {
 public:
  struct Choice {
    SearchMode mode = SearchMode::none;
    /// Not 0: an index is worth so much of being built. If that makes it ready, `probe` takes the place of `mode`.
    prices::Price worth_of_index = 0;
    /// Candidates are to be dropped.
    bool gives_up = false;
  };
  Choice choose(const SearchState& state);

  /// Whether candidates have to be made anew: there are none, or exits now would raise the average cost of an update,
  /// or exits since the last time have cost as much as that.
  bool is_rebuild(const SearchState& state) const;

  /// What is done with candidates in this update.
  void rebuilds(const SearchState& state);
  void passes(const SearchState& state);
  /// They have not paid, or are too many.
  void gives_up();

 private:
  enum class Answer { yes, no, never };
  Answer candidates_pay(const SearchState& state, prices::Price otherwise);

  std::int64_t gained_ = 0;  // by candidates, since they were made
  prices::Price spent_ = 0, spent_on_exits_ = 0;
  std::uint64_t updates_ = 0;
  unsigned failures_ = 0;  // times that candidates have not paid
  unsigned wait_ = 0;      // updates before they are tried again
};

}  // namespace boxstream::detail
