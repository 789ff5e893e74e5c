// SPDX-License-Identifier: MIT
#include "world/state/pairs.hpp"

#include <algorithm>
#include <bit>
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
  ++edition_;
}

bool HeldPairs::release(PairKey key) {
  if (removed_.size() >= thresholds.longest_side_list) fold();
  if (recheck_.size() == recheck_.capacity()) {
    // Releasing and beginning again, over and over without an update, must not take ever more memory.
    std::sort(recheck_.begin(), recheck_.end());
    recheck_.erase(std::unique(recheck_.begin(), recheck_.end()), recheck_.end());
    recheck_.reserve(std::max<std::size_t>(16, 2 * recheck_.size()));  // unless few are left, not again so soon
  }
  const bool was_held = take(key);
  recheck_.push_back(key);
  edition_ += was_held;
  return was_held;
}

/// Returns whether it was held.
bool HeldPairs::take(PairKey key) {
  if (erase(added_, key)) return true;
  if (!lists_.contains(key) || has(removed_, key)) return false;
  insert(removed_, key);
  return true;
}

void HeldPairs::find_places(Span<const PairKey> keys, std::vector<std::uint32_t>& places) const {
  if (is_folded()) return lists_.find_places(keys, places);
  places.clear();
  reserve_more(places, keys.size());
  for (const PairKey key : keys) places.push_back(static_cast<std::uint32_t>(place(key)));
}

void HeldPairs::exchange_few(Span<const PairKey> gone, Span<const std::uint32_t> places, Span<const PairKey> added,
                             std::vector<std::uint32_t>& arrived) {
  assert(gone.size() == places.size());
  if (size() - gone.size() + added.size() > PairLists::most)
    throw std::length_error("boxstream: more than 2^32 - 64 pairs held");
  // As many as are worth a fold of so many pairs, at once: pairs that come and go now and then take no memory for long.
  const std::size_t worth_folding = std::max<std::size_t>(16, std::bit_floor(lists_.size() / 8));
  const std::size_t longest = std::min(worth_folding, thresholds.longest_side_list_of_updates);
  if (added_.size() + removed_.size() + gone.size() + added.size() > longest) fold();
  added_.reserve(std::max(longest, added_.size() + added.size()));
  removed_.reserve(std::max(longest, removed_.size() + gone.size()));
  arrived.clear();
  reserve_more(arrived, added.size());
  std::size_t left = 0;
  for (std::size_t i = 0; i < added.size(); ++i) {
    const std::size_t at = place(added[i]);
    while (left < gone.size() && places[left] < at) ++left;
    arrived.push_back(static_cast<std::uint32_t>(at + i - left));
  }
  for (const PairKey key : gone)
    if (!erase(added_, key)) insert(removed_, key);
  for (const PairKey key : added)
    if (!erase(removed_, key)) insert(added_, key);
  ++edition_;
}

void HeldPairs::fold_sides() {
  std::uint32_t last = 0;
  for (const PairKey key : added_) last = std::max(last, second_of(key));
  lists_.reserve_ranks(std::size_t{last} + 1);
  lists_.find_places(removed_, gone_);
  lists_.exchange(gone_, added_, arrived_);
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
