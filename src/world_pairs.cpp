// SPDX-License-Identifier: MIT
#include "world_pairs.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>

#include "world_reserve.hpp"

namespace boxstream::detail {

namespace {

// Inserting into a side list moves what follows; folding copies the whole array. At this length the first still costs
// less than a microsecond, and the second is paid once in this many calls.
constexpr std::size_t longest_side_list = 1024;

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
  return has(added_, key) || (has(keys_, key) && !has(removed_, key));
}

void HeldPairs::add(PairKey key) {
  if (added_.size() >= longest_side_list) fold();
  if (!erase(removed_, key)) insert(added_, key);
}

bool HeldPairs::release(PairKey key) {
  if (removed_.size() >= longest_side_list) fold();
  if (doubtful_.size() == doubtful_.capacity()) {
    // Releasing and beginning again, over and over without an update, must not take ever more memory.
    std::sort(doubtful_.begin(), doubtful_.end());
    doubtful_.erase(std::unique(doubtful_.begin(), doubtful_.end()), doubtful_.end());
  }
  reserve_one_more(doubtful_);
  if (!erase(added_, key)) {
    if (!has(keys_, key) || has(removed_, key)) return false;
    insert(removed_, key);
  }
  doubtful_.push_back(key);
  return true;
}

const std::vector<PairKey>& HeldPairs::fold() {
  if (added_.empty() && removed_.empty()) return keys_;
  scratch_.clear();
  scratch_.reserve(keys_.size() + added_.size());
  for_each([this](PairKey key) {
    scratch_.push_back(key);
    return true;
  });
  keys_.swap(scratch_);
  added_.clear();
  removed_.clear();
  return keys_;
}

void HeldPairs::replace(std::vector<PairKey>& keys, std::vector<PairKey>& doubtful) noexcept {
  keys_.swap(keys);
  doubtful_.swap(doubtful);
}

void HeldPairs::remap(Span<const std::uint32_t> new_rank) noexcept {
  const auto renamed = [&](PairKey key) { return PairKey{new_rank[first_of(key)]} << 32 | new_rank[second_of(key)]; };
  for (auto* list : {&keys_, &added_, &removed_})
    for (PairKey& key : *list) key = renamed(key);
  std::size_t kept = 0;
  constexpr std::uint32_t dropped = std::numeric_limits<std::uint32_t>::max();
  for (const PairKey key : doubtful_)
    if (new_rank[first_of(key)] != dropped && new_rank[second_of(key)] != dropped) doubtful_[kept++] = renamed(key);
  doubtful_.resize(kept);
}

void HeldPairs::clear() noexcept {
  keys_.clear();
  added_.clear();
  removed_.clear();
  doubtful_.clear();
}

void HeldPairs::validate() const {
  for (const auto* list : {&keys_, &added_, &removed_})
    if (std::adjacent_find(list->begin(), list->end(), std::greater_equal<>()) != list->end())
      throw std::logic_error("held pairs are not strictly sorted");
  for (const PairKey key : added_)
    if (has(keys_, key)) throw std::logic_error("a pair is held twice");
  for (const PairKey key : removed_)
    if (!has(keys_, key)) throw std::logic_error("a released pair was never held");
  bool ordered = true;
  for_each([&](PairKey key) { return ordered = first_of(key) < second_of(key); });
  if (!ordered) throw std::logic_error("a held pair is not (older, younger)");
}

}  // namespace boxstream::detail
