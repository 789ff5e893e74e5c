// SPDX-License-Identifier: MIT
#include "pair_store.hpp"

#include <algorithm>
#include <new>

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
  splice(displaced_, {}, loose_);
  displaced_.clear();
  std::sort(loose_.begin(), loose_.end());
  splice({}, loose_, loose_);
}

void PairStore::splice(const std::vector<std::uint32_t>& gone, const std::vector<KeyedPair>& added,
                       std::vector<KeyedPair>& removed) {
  if (gone.empty() && added.empty()) return;
  links_.drop();
  // Runs of pairs that stay side by side, and where the added ones go.
  runs_.clear();
  arrivals_.clear();
  const std::uint32_t old_size = size();
  std::uint32_t begin = 0;
  std::int64_t shift = 0;
  auto leaving = gone.begin();
  const auto end_run_at = [&](std::uint32_t end) {
    if (shift != 0 && begin != end) runs_.push_back({begin, end, shift});
    begin = end;
  };
  const auto let_go_before = [&](std::uint32_t place) {
    for (; leaving != gone.end() && *leaving < place; ++leaving) {
      end_run_at(*leaving);
      removed.emplace_back(keys_[*leaving], pairs_[int(*leaving)]);
      begin = *leaving + 1;
      --shift;
    }
  };
  for (const KeyedPair& pair : added) {
    const auto place = std::uint32_t(std::lower_bound(keys_.begin() + begin, keys_.end(), pair.key) - keys_.begin());
    let_go_before(place);
    end_run_at(place);
    arrivals_.push_back(std::uint32_t(place + shift));
    ++shift;
  }
  let_go_before(old_size);
  end_run_at(old_size);

  const std::uint64_t new_size = std::uint64_t(old_size) + added.size() - gone.size();
  grow_to(std::max<std::uint64_t>(old_size, new_size));
  move_runs();
  for (std::size_t i = 0; i < added.size(); ++i) {
    pairs_[int(arrivals_[i])] = added[i].pair;
    keys_[arrivals_[i]] = added[i].key;
  }
  pairs_.resizeNoInitialize(int(new_size));
  keys_.resize(new_size);
  in_order_ = size();
}

/// Runs that move down free the places of those after them, runs that move up the places of those before. Between the
/// two kinds there is always room.
void PairStore::move_runs() {
  if (runs_.empty()) return;
  btBroadphasePair* const pairs = &pairs_[0];
  const auto move = [&](const Run& run) {
    const auto to = std::ptrdiff_t(run.begin + run.shift);
    const auto count = std::size_t(run.end - run.begin);
    if (run.shift < 0) {
      std::copy_n(pairs + run.begin, count, pairs + to);
      std::copy_n(keys_.begin() + run.begin, count, keys_.begin() + to);
    } else {
      std::copy_backward(pairs + run.begin, pairs + run.end, pairs + run.end + run.shift);
      std::copy_backward(keys_.begin() + run.begin, keys_.begin() + run.end, keys_.begin() + run.end + run.shift);
    }
  };
  for (std::size_t i = 0; i < runs_.size();) {
    std::size_t end = i;
    while (end < runs_.size() && runs_[end].shift > 0) ++end;
    for (std::size_t k = end; k-- > i;) move(runs_[k]);
    i = end;
    for (; i < runs_.size() && runs_[i].shift < 0; ++i) move(runs_[i]);
  }
}

bool PairStore::contains_sorted(std::uint64_t key) const {
  return std::binary_search(keys_.begin(), keys_.end(), key);
}

void PairStore::grow_to(std::uint64_t new_size) {
  // btAlignedObjectArray counts in int and doubles; the links need two values per pair.
  constexpr std::uint64_t limit = std::uint64_t{1} << 30;
  if (new_size >= limit) fatal("2^30 pairs overlap, more than Bullet's pair array can hold");
  if (new_size > std::uint64_t(pairs_.capacity())) {
    pairs_.reserve(int(std::min(std::max(new_size, 2 * std::uint64_t(pairs_.capacity())), limit)));
    // Without memory, Bullet's array becomes an empty one and says nothing.
    if (new_size > std::uint64_t(pairs_.capacity())) throw std::bad_alloc();
  }
  pairs_.resizeNoInitialize(int(new_size));
  keys_.resize(new_size);
}

void PairStore::link() {
  if (!links_.built()) links_.build(pairs_);
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
