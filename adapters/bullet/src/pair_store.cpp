// SPDX-License-Identifier: MIT
#include "pair_store.hpp"

#include <algorithm>

#include "fatal.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

std::uint32_t PairStore::find(const Proxy& low, const Proxy& high) {
  const std::uint64_t key = pair_key(low, high);
  // Past this many unsorted pairs, one pass to link them all pays off.
  constexpr std::uint32_t longest_scan = 64;
  if (!links_.built() && displaced_.empty() && size() - in_order_ <= longest_scan) {
    const auto sorted_end = keys_.begin() + in_order_;
    const auto sorted = std::lower_bound(keys_.begin(), sorted_end, key);
    if (sorted != sorted_end && *sorted == key) return std::uint32_t(sorted - keys_.begin());
    const auto loose = std::find(sorted_end, keys_.end(), key);
    return loose == keys_.end() ? npos : std::uint32_t(loose - keys_.begin());
  }
  link();
  const Proxy& rarer = links_.degree(low) < links_.degree(high) ? low : high;
  for (std::uint32_t node = links_.first(rarer); node != no_link; node = links_.next(node))
    if (keys_[node / 2] == key) return node / 2;
  return npos;
}

std::uint32_t PairStore::any_of(const Proxy& proxy) {
  link();
  const std::uint32_t node = links_.first(proxy);
  return node == no_link ? npos : node / 2;
}

std::uint32_t PairStore::add(const KeyedPair& added) {
  const std::uint32_t index = size();
  grow_to(std::uint64_t(index) + 1);
  pairs_[int(index)] = added.pair;
  keys_[index] = added.key;
  if (links_.built()) links_.add(added.pair, index);
  return index;
}

void PairStore::remove(std::uint32_t index) {
  const std::uint32_t last = size() - 1;
  if (links_.built()) links_.remove(pairs_[int(index)], index);
  if (index != last) {
    if (links_.built()) links_.move(pairs_[int(last)], last, index);
    pairs_[int(index)] = pairs_[int(last)];
    keys_[index] = keys_[last];
    if (index < in_order_) displaced_.push_back(index);
  }
  pairs_.pop_back();
  keys_.pop_back();
  in_order_ = std::min(in_order_, last);
}

void PairStore::restore_order() {
  if (displaced_.empty() && in_order_ == size()) return;
  std::sort(displaced_.begin(), displaced_.end());
  displaced_.erase(std::unique(displaced_.begin(), displaced_.end()), displaced_.end());
  displaced_.erase(std::lower_bound(displaced_.begin(), displaced_.end(), in_order_), displaced_.end());
  for (std::uint32_t index = in_order_; index < size(); ++index) displaced_.push_back(index);

  loose_.clear();
  take_out(displaced_, loose_);
  displaced_.clear();
  std::sort(loose_.begin(), loose_.end());
  add_sorted(loose_);
}

void PairStore::take_out(const std::vector<std::uint32_t>& ascending, std::vector<KeyedPair>& out) {
  if (ascending.empty()) return;
  links_.drop();
  btBroadphasePair* const pairs = &pairs_[0];
  std::uint32_t kept = 0, next = 0;
  const auto close_up_to = [&](std::uint32_t end) {
    if (kept != next) {
      std::copy(pairs + next, pairs + end, pairs + kept);
      std::copy(keys_.begin() + next, keys_.begin() + end, keys_.begin() + kept);
    }
    kept += end - next;
  };
  for (const std::uint32_t index : ascending) {
    close_up_to(index);
    out.emplace_back(keys_[index], pairs[index]);
    next = index + 1;
  }
  close_up_to(size());
  pairs_.resizeNoInitialize(int(kept));
  keys_.resize(kept);
  in_order_ = kept;
}

void PairStore::add_sorted(const std::vector<KeyedPair>& added) {
  if (added.empty()) return;
  links_.drop();
  std::uint32_t end = size();  // of the old pairs that are not in their new place yet
  grow_to(std::uint64_t(end) + added.size());
  btBroadphasePair* const pairs = &pairs_[0];
  std::uint32_t free_end = size();
  for (std::size_t i = added.size(); i-- > 0;) {
    const auto place = std::lower_bound(keys_.begin(), keys_.begin() + end, added[i].key);
    const auto index = std::uint32_t(place - keys_.begin());
    std::copy_backward(pairs + index, pairs + end, pairs + free_end);
    std::copy_backward(keys_.begin() + index, keys_.begin() + end, keys_.begin() + free_end);
    free_end -= end - index + 1;
    end = index;
    pairs[free_end] = added[i].pair;
    keys_[free_end] = added[i].key;
  }
  in_order_ = size();
}

bool PairStore::contains_sorted(std::uint64_t key) const {
  return std::binary_search(keys_.begin(), keys_.end(), key);
}

void PairStore::grow_to(std::uint64_t new_size) {
  // btAlignedObjectArray counts in int and doubles; the links need two values per pair.
  constexpr std::uint64_t limit = std::uint64_t{1} << 30;
  if (new_size >= limit) fatal("2^30 pairs overlap, more than Bullet's pair array can hold");
  if (new_size > std::uint64_t(pairs_.capacity()))
    pairs_.reserve(int(std::min(std::max(new_size, 2 * std::uint64_t(pairs_.capacity())), limit)));
  pairs_.resizeNoInitialize(int(new_size));
  keys_.resize(new_size);
}

void PairStore::link() {
  if (!links_.built()) links_.build(pairs_);
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
