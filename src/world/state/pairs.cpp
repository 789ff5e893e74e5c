// SPDX-License-Identifier: MIT
#include "world/state/pairs.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <limits>
#include <stdexcept>

#include "base/reserve.hpp"
#include "base/thresholds.hpp"

namespace boxstream::detail {

namespace {

bool has(const std::vector<PairKey>& sorted, PairKey key) {
  return std::binary_search(sorted.begin(), sorted.end(), key);
}

void insert(std::vector<PairKey>& sorted, PairKey key) {
  reserve_one_more(sorted);
  sorted.insert(std::lower_bound(sorted.begin(), sorted.end(), key), key);
}

bool erase(std::vector<PairKey>& sorted, PairKey key) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), key);
  if (at == sorted.end() || *at != key) return false;
  sorted.erase(at);
  return true;
}

}  // namespace

bool HeldPairs::contains(PairKey key) const {
  return has(added_, key) || (lists_.contains(key) && !has(removed_, key));
}

std::size_t HeldPairs::place(PairKey key) const {
  const auto before = [key](const std::vector<PairKey>& sorted) {
    return std::lower_bound(sorted.begin(), sorted.end(), key) - sorted.begin();
  };
  return lists_.place(key) + static_cast<std::size_t>(before(added_) - before(removed_));
}

void HeldPairs::add(PairKey key) {
  assert(!contains(key) && first_of(key) < second_of(key));
  if (added_.size() >= thresholds.longest_side_list) fold();
  if (!erase(removed_, key)) insert(added_, key);
}

bool HeldPairs::release(PairKey key) {
  if (removed_.size() >= thresholds.longest_side_list) fold();
  if (recheck_.size() == recheck_.capacity()) {
    // Releasing and beginning again, over and over without an update, must not take ever more memory.
    std::sort(recheck_.begin(), recheck_.end());
    recheck_.erase(std::unique(recheck_.begin(), recheck_.end()), recheck_.end());
  }
  reserve_one_more(recheck_);
  const bool was_held = take(key);
  recheck_.push_back(key);
  return was_held;
}

/// Returns whether it was held.
bool HeldPairs::take(PairKey key) {
  if (erase(added_, key)) return true;
  if (!lists_.contains(key) || has(removed_, key)) return false;
  insert(removed_, key);
  return true;
}

/// A few go to the side lists: of the others a few words are read, instead of all moved. These lists are read for each
/// pair, so that they stay short.
void HeldPairs::change(Span<const PairKey> gone, Span<const PairKey> added, std::vector<std::uint32_t>& gone_places,
                       std::vector<std::uint32_t>& added_places) {
  constexpr std::size_t most = std::min<std::size_t>(128, thresholds.longest_side_list);
  const std::size_t events = gone.size() + added.size();
  if (added_.size() + removed_.size() + events > most) fold();
  if (events > most) {
    if (!added.empty()) lists_.reserve_ranks(std::size_t{first_of(added[added.size() - 1])} + 1);
    lists_.find_places(gone, gone_places);
    lists_.exchange(gone_places, added, added_places);
    return lists_changed();
  }
  const auto find_places = [this](Span<const PairKey> keys, std::vector<std::uint32_t>& places) {
    std::transform(keys.begin(), keys.end(), places.begin(),
                   [this](PairKey key) { return static_cast<std::uint32_t>(place(key)); });
  };
  gone_places.resize(gone.size());
  added_places.resize(added.size());
  reserve_more(added_, added.size());
  reserve_more(removed_, gone.size());
  find_places(gone, gone_places);
  for (const PairKey key : gone) take(key);
  for (const PairKey key : added) add(key);
  find_places(added, added_places);
}

void HeldPairs::fold_sides() {
  if (!added_.empty()) lists_.reserve_ranks(std::size_t{first_of(added_.back())} + 1);
  lists_.find_places(removed_, gone_);
  lists_.exchange(gone_, added_, arrived_);
  lists_changed();
  added_.clear();
  removed_.clear();
}

void HeldPairs::remap(Span<const std::uint32_t> new_rank) noexcept {
  assert(is_folded());
  constexpr std::uint32_t dropped = std::numeric_limits<std::uint32_t>::max();
  lists_.remap(new_rank, dropped);
  lists_changed();
  std::size_t kept = 0;
  for (const PairKey key : recheck_) {
    const std::uint32_t a = new_rank[first_of(key)];
    const std::uint32_t b = new_rank[second_of(key)];
    if (a != dropped && b != dropped) recheck_[kept++] = pair_key(a, b);
  }
  recheck_.resize(kept);
}

void HeldPairs::clear() noexcept {
  lists_.clear();
  lists_changed();
  added_.clear();
  removed_.clear();
  recheck_.clear();
}

void HeldPairs::validate() const {
  lists_.validate();
  for (const auto* list : {&added_, &removed_})
    if (std::adjacent_find(list->begin(), list->end(), std::greater_equal<>()) != list->end())
      throw std::logic_error("side lists are not strictly sorted");
  for (const PairKey key : added_) {
    if (lists_.contains(key)) throw std::logic_error("a pair is held twice");
    if (first_of(key) >= second_of(key)) throw std::logic_error("a held pair is not (older, younger)");
  }
  for (const PairKey key : removed_)
    if (!lists_.contains(key)) throw std::logic_error("a released pair was never held");
}

}  // namespace boxstream::detail
