// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
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
  rows,        ///< few boxes: rows of bits of all
  dirty_rows,  ///< few boxes: rows of bits of the dirty ones
};

/// What an update begins with, as far as prices depend on it.
struct SearchState {
  std::size_t boxes = 0, dirty = 0;
  std::size_t pairs = 0;       ///< held
  std::size_t threads = 1;     ///< of a batch, and of a probe
  bool has_index = false;      ///< that a probe can ask as it is
  bool index_is_worn = false;  ///< but not for long: see Bvh::is_worn
  bool is_few = false;         ///< boxes are columns too: see FewBoxes
  CandidateState candidates;
  prices::Price planned = 0;  ///< with candidates, where there are none: see FatBoxes::planned_price
};

/// Chooses, update by update, what is expected to cost least, by the list of prices and by accounts of what the
/// updates so far have cost.
///
/// - Rooms, which are no search, are made where the same boxes move again. Where they are left at once, or cannot be
///   made, they are tried less and less often.
/// - An index is built bit by bit, by what probes would have saved: the total is at most twice that of the better
///   choice.
/// - Few boxes are compared by rows of bits, or in a batch. Neither keeps anything, so that an index is of no use, and
///   candidates only where that costs much.
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

  /// What is cheapest for few boxes without candidates, and whether that is so cheap that nothing else is looked at.
  struct FewChoice {
    SearchMode mode;
    bool is_final;
  };
  static FewChoice choose_of_few(std::size_t boxes, std::size_t dirty, std::size_t pairs) {
    const prices::Price price = least_of_few(boxes, dirty, pairs);
    const bool by_dirty = prices::dirty_rows(boxes, dirty) == price, by_rows = prices::rows(boxes) == price;
    const SearchMode mode = by_dirty ? SearchMode::dirty_rows : by_rows ? SearchMode::rows : SearchMode::all;
    return {mode, price_of_few(boxes, dirty, pairs) < thresholds.cheap_of_few};
  }

  /// Whether rooms are worth a try, when the same boxes have moved as in the update before.
  bool tries_rooms() {
    if (rooms_wait_ == 0) return true;
    --rooms_wait_;
    return false;
  }
  /// For how many updates rooms have held; for none if they could not be made.
  void rooms_lasted(unsigned updates) {
    const bool pay = updates >= thresholds.rooms_pay;
    rooms_failures_ = pay ? 0 : std::min(rooms_failures_ + 1, 10u);
    rooms_wait_ = pay ? 0 : 1u << rooms_failures_;
  }

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
  static prices::Price least_of_few(std::size_t boxes, std::size_t dirty, std::size_t pairs) {
    return std::min({prices::dirty_rows(boxes, dirty), prices::rows(boxes),
                     prices::all(boxes) + prices::pairs_of_batch(boxes, pairs)});
  }
  /// Beside candidates: few boxes are compared where nothing is kept or planned, in half the time that it takes of
  /// many.
  static prices::Price price_of_few(std::size_t boxes, std::size_t dirty, std::size_t pairs) {
    return least_of_few(boxes, dirty, pairs) / 2;
  }
  Answer candidates_pay(const SearchState& state, prices::Price otherwise);

  std::int64_t gained_ = 0;  // by candidates, since they were made
  prices::Price spent_ = 0, spent_on_exits_ = 0;
  std::uint64_t updates_ = 0;
  unsigned failures_ = 0;                         // times that candidates have not paid
  unsigned wait_ = 0;                             // updates before they are tried again
  unsigned rooms_failures_ = 0, rooms_wait_ = 0;  // the same of rooms
};

}  // namespace boxstream::detail
