// SPDX-License-Identifier: MIT
#include "pair_store.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <new>
#include <numeric>
#include <utility>

#include <LinearMath/btAlignedAllocator.h>

#include "fatal.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

/// Bullet's array does not check its allocations: this allocates first, to find out.
void require_memory(std::size_t bytes) {
  void* const memory = btAlignedAlloc(bytes, 16);
  if (memory == nullptr) throw std::bad_alloc();
  btAlignedFree(memory);
}

}  // namespace

bool comes_before(const btBroadphasePair& x, const btBroadphasePair& y) {
  const auto ages = [](const btBroadphasePair& pair) {
    return std::minmax(static_cast<const Proxy*>(pair.m_pProxy0)->created,
                       static_cast<const Proxy*>(pair.m_pProxy1)->created);
  };
  return std::pair<std::uint64_t, std::uint64_t>(ages(x)) < std::pair<std::uint64_t, std::uint64_t>(ages(y));
}

std::uint32_t PairStore::find(const Proxy& a, const Proxy& b) {
  splice_late();
  // Past this many pairs at the end, one pass to link them all pays off.
  constexpr std::uint32_t longest_scan = 64;
  if (!links_.built() && is_in_world_order() && size() - world_pairs_ <= longest_scan) {
    if (size() == 0) return npos;
    const btBroadphasePair wanted(const_cast<Proxy&>(a), const_cast<Proxy&>(b));
    const btBroadphasePair *const first = &pairs_[0], *const others = first + world_pairs_, *const end = first + size();
    const btBroadphasePair* place = std::lower_bound(first, others, wanted, comes_before);
    if (place == others || !(*place == wanted)) place = std::find(others, end, wanted);
    return place == end ? npos : std::uint32_t(place - first);
  }
  build_links();
  const Proxy& rarer = links_.degree(a) < links_.degree(b) ? a : b;
  const Proxy& other = &rarer == &a ? b : a;
  for (std::uint32_t node = links_.first(rarer); node != no_link; node = links_.next(node))
    if ((node % 2 == 0 ? pairs_[int(node / 2)].m_pProxy1 : pairs_[int(node / 2)].m_pProxy0) == &other) return node / 2;
  return npos;
}

/// Where removals have moved pairs, lists are made in the order of before, so that what ends does so in an order that
/// is a function of the pairs.
void PairStore::build_links() {
  if (links_.built() || removals_.empty()) return links_.build(pairs_);
  const std::size_t before = size() + removals_.size();
  std::vector<std::uint32_t>&place = gone_, &order = arrived_;  // scratch that batches use
  place.resize(before);
  std::iota(place.begin(), place.end(), 0u);
  for (const Removal& removal : removals_) place[removal.index] = place[removal.last];
  order.assign(before, no_link);
  for (std::uint32_t i = 0; i < size(); ++i)
    if (std::uint32_t& here = order[place[i]]; here == no_link)
      here = i;
    else
      order.push_back(i);  // added where another one had been
  links_.build(pairs_, order);
}

bool PairStore::scan(const Proxy& proxy) {
  if (links_.built()) return false;
  if (scanned_for_ == &proxy) return true;
  if (!removals_.empty()) {
    build_links();
    return false;
  }
  scanned_for_ = nullptr;
  scanned_.clear();
  const btBroadphasePair* const pairs = size() == 0 ? nullptr : &pairs_[0];
  for (std::uint32_t i = 0; i < size(); ++i)
    if ((pairs[i].m_pProxy0 == &proxy) | (pairs[i].m_pProxy1 == &proxy)) scanned_.push_back(i);
  scanned_for_ = &proxy;
  return true;
}

void PairStore::forget_places() {
  links_.drop();
  scanned_for_ = nullptr;
}

std::uint32_t PairStore::any_of(const Proxy& proxy) {
  splice_late();
  if (scan(proxy)) return scanned_.empty() ? npos : scanned_.back();
  const std::uint32_t node = links_.first(proxy);
  return node == no_link ? npos : node / 2;
}

std::uint32_t PairStore::add(const btBroadphasePair& added) {
  splice_late();
  const std::uint32_t index = size();
  grow_to(std::uint64_t(index) + 1);
  pairs_[int(index)] = added;
  scanned_for_ = nullptr;
  if (links_.built()) links_.add(added, index);
  return index;
}

void PairStore::remove(std::uint32_t index) {
  splice_late();
  const std::uint32_t last = size() - 1;
  removals_.push_back({index, last});
  // What moves to the free place is behind all places that are left in the list.
  if (!scanned_.empty() && scanned_.back() == index)
    scanned_.pop_back();
  else
    scanned_for_ = nullptr;
  if (links_.built()) links_.remove(pairs_[int(index)], index);
  if (index != last) {
    if (links_.built()) links_.move(pairs_[int(last)], last, index);
    pairs_[int(index)] = pairs_[int(last)];
  }
  pairs_.pop_back();
}

/// Undoes removals, the last one first. Pairs added since are behind `last` pairs, in any order.
void PairStore::undo_moves() {
  if (is_in_world_order()) return;
  forget_places();
  for (; !removals_.empty(); removals_.pop_back()) {
    const auto [index, last] = removals_.back();
    btBroadphasePair back;
    if (index != last) std::swap(back, pairs_[int(index)]);
    if (last < size()) std::swap(back, pairs_[int(last)]);
    add(back);
  }
  if (!std::exchange(is_sorted_, false)) return;
  const std::uint32_t sorted = std::uint32_t(order_.size()), added = size() - sorted;
  others_.clear();
  for (std::uint32_t i = 0; i < size(); ++i) others_.push_back(pairs_[int(i)]);
  if (size_with_holes_ + added == 0) return;
  grow_to(size_with_holes_ + added);
  btBroadphasePair* const pairs = &pairs_[0];
  std::fill_n(pairs, size_with_holes_, btBroadphasePair());
  for (std::uint32_t i = 0; i < sorted; ++i) pairs[order_[i]] = others_[i];
  std::copy(others_.begin() + sorted, others_.end(), pairs + size_with_holes_);
}

void PairStore::give_back_unused() {
  constexpr unsigned patience = 8;
  const std::size_t spare = 1024 + std::size_t(size());
  const bool lies_idle = std::max(std::size_t(pairs_.capacity()), others_.capacity()) > spare + size();
  batches_with_less_ = lies_idle ? batches_with_less_ + 1 : 0;
  if (batches_with_less_ >= patience) give_back(spare);
}

/// Room for `spare` pairs may stay.
void PairStore::give_back(std::size_t spare) {
  if (!is_in_world_order()) return;
  splice_late();
  late_.give_back();
  batches_with_less_ = 0;
  forget_places();
  links_.give_back();
  for (auto* list : {&gone_, &arrived_, &scanned_, &order_}) std::vector<std::uint32_t>().swap(*list);
  std::vector<Removal>().swap(removals_);
  std::vector<btBroadphasePair>().swap(others_);
  if (std::size_t(pairs_.capacity()) <= spare + size()) return;
  std::vector<btBroadphasePair> kept;
  kept.reserve(size());
  for (std::uint32_t i = 0; i < size(); ++i) kept.push_back(pairs_[int(i)]);
  pairs_.clear();
  grow_to(kept.size());
  for (std::uint32_t i = 0; i < size(); ++i) pairs_[int(i)] = kept[i];
}

void PairStore::clear() {
  in_place_ = npos;
  late_.give_back();
  forget_places();
  pairs_.clear();
  is_sorted_ = false;
  world_pairs_ = prepared_ = 0;
  std::vector<Removal>().swap(removals_);
  std::vector<btBroadphasePair>().swap(others_);
  for (auto* list : {&gone_, &arrived_, &order_, &scanned_}) std::vector<std::uint32_t>().swap(*list);
  links_ = PairLinks();
}

void PairStore::restore_order() {
  splice_late();
  if (removals_.empty() && size() == (is_sorted_ ? order_.size() : world_pairs_)) return;
  undo_moves();
  forget_places();
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < size(); ++i)
    if (pairs_[int(i)].m_pProxy0) order.push_back(i);
  const auto is_before = [this](std::uint32_t x, std::uint32_t y) {
    return comes_before(pairs_[int(x)], pairs_[int(y)]);
  };
  const auto others = std::lower_bound(order.begin(), order.end(), world_pairs_);
  std::sort(others, order.end(), is_before);
  std::inplace_merge(order.begin(), others, order.end(), is_before);
  size_with_holes_ = size();
  others_.clear();
  for (const std::uint32_t i : order) others_.push_back(pairs_[int(i)]);
  pairs_.resizeNoInitialize(int(order.size()));
  for (std::uint32_t i = 0; i < size(); ++i) pairs_[int(i)] = others_[i];
  order_ = std::move(order);
  is_sorted_ = true;
}

void PairStore::put_in(std::vector<btBroadphasePair>& begun) {
  if (begun.empty()) return;
  splice_late();
  forget_places();
  std::sort(begun.begin(), begun.end(), comes_before);
  auto old = int(size());
  grow_to(size() + begun.size());
  auto place = int(size());
  world_pairs_ = size();
  for (std::size_t left = begun.size(); left > 0; pairs_[place] = begun[--left])
    for (--place; old > 0 && comes_before(begun[left - 1], pairs_[old - 1]); --place) pairs_[place] = pairs_[--old];
}

void PairStore::settle() {
  splice_late();
  forget_places();
  if (!is_settled() && size() != 0) std::sort(&pairs_[0], &pairs_[0] + size(), comes_before);
  removals_.clear();
  is_sorted_ = false;
  world_pairs_ = size();
}

/// Few of the holes that undo_moves leaves come of the removals alone, many of a look at all pairs. Fills `gone_`.
void PairStore::find_holes() {
  constexpr std::size_t few = 64;
  has_many_holes_ = is_sorted_ || removals_.size() > few;
  if (has_many_holes_) return;
  gone_.clear();
  for (auto removal = removals_.rbegin(); removal != removals_.rend(); ++removal) {
    for (std::uint32_t& hole : gone_)
      if (hole == removal->last)
        hole = npos;  // goes behind all pairs, for another one was added there
      else if (hole == removal->index)
        hole = removal->last;
    gone_.push_back(removal->index);
  }
  std::sort(gone_.begin(), gone_.end());
  gone_.erase(std::lower_bound(gone_.begin(), gone_.end(), world_pairs_), gone_.end());
}

void PairStore::prepare(const World& world) {
  prepared_ = size();
  if (is_in_world_order() && size() == world_pairs_) return;
  find_holes();
  undo_moves();
  take_others();
  if (has_many_holes_) {
    gone_.clear();
    for (std::uint32_t i = 0; i < world_pairs_; ++i)
      if (!pairs_[int(i)].m_pProxy0) gone_.push_back(i);
  }
  arrived_.clear();
  for (const btBroadphasePair& pair : others_)
    if (const auto place = place_in(world, pair)) arrived_.push_back(*place);
  std::sort(arrived_.begin(), arrived_.end());
  splice({gone_, arrived_});
  for (const btBroadphasePair& pair : others_)
    if (const auto place = place_in(world, pair)) pairs_[int(*place)] = pair;
  for (const btBroadphasePair& pair : others_)
    if (!place_in(world, pair)) add(pair);
  prepared_ = size();
  assert(world_pairs_ == world.pair_count() && "the pairs of the World and of the cache differ");
}

/// False if it has to be done now.
bool PairStore::follow_late(const World& world, std::vector<btBroadphasePair>& ended,
                            std::vector<btBroadphasePair>& begun) {
  const Splice changes = world.changes();
  constexpr std::size_t pairs_of_event = 16;
  if (is_lent_ || pairs_of_event * (changes.removed.size() + changes.inserted.size()) > size()) return false;
  splice_late();
  forget_places();
  others_.clear();
  for (const ProxyPair& pair : world.begun()) others_.emplace_back(proxy_of(world, pair.a), proxy_of(world, pair.b));
  if (std::any_of(others_.begin(), others_.end(), has_destroyed)) return false;
  const std::uint32_t old_size = size();
  const std::size_t in_place = late_.begin(changes, others_.data(), old_size);
  for (const std::uint32_t place : changes.removed) ended.push_back(pairs_[int(place)]);
  begun.insert(begun.end(), others_.begin(), others_.end());
  grow_to(std::max<std::size_t>(old_size, late_.next_size()));
  world_pairs_ = std::uint32_t(late_.next_size());
  in_place_.store(std::uint32_t(in_place), std::memory_order_release);
  return true;
}

void PairStore::splice_until(std::uint32_t end) {
  const std::size_t done = late_.go_on(&pairs_[0], in_place_.load(std::memory_order_relaxed), end);
  if (done == late_.next_size()) pairs_.resizeNoInitialize(int(done));
  in_place_.store(done == late_.next_size() ? npos : std::uint32_t(done), std::memory_order_release);
}

/// Programs may read the pairs from several threads.
void PairStore::splice_all() {
  const std::lock_guard lock(splicing_);
  if (is_late()) splice_until(world_pairs_);
}

/// Moves the pairs behind those of the World to `others_`. Returns how many were there before the update.
std::size_t PairStore::take_others() {
  forget_places();
  others_.clear();
  std::size_t old = 0;
  for (std::uint32_t i = world_pairs_; i < size(); ++i) {
    if (!pairs_[int(i)].m_pProxy0) continue;
    others_.push_back(pairs_[int(i)]);
    old += i < prepared_;
  }
  pairs_.resizeNoInitialize(int(world_pairs_));
  return old;
}

/// Leaves holes at the places of pairs that arrive.
void PairStore::splice(const Splice& changes) {
  const std::uint32_t old_size = size();
  const std::size_t new_size = old_size + changes.inserted.size() - changes.removed.size();
  grow_to(std::max<std::size_t>(old_size, new_size));
  btBroadphasePair* const pairs = new_size == 0 ? nullptr : &pairs_[0];
  // They are pointers, whatever their copy constructor is.
  move_runs(old_size, changes, [pairs](std::size_t from, std::size_t count, std::size_t to) {
    std::memmove(static_cast<void*>(pairs + to), static_cast<const void*>(pairs + from), count * sizeof(*pairs));
  });
  for (const std::uint32_t place : changes.inserted) pairs_[int(place)] = btBroadphasePair();
  pairs_.resizeNoInitialize(int(new_size));
  world_pairs_ = size();
}

void PairStore::grow_to(std::uint64_t new_size) {
  // btAlignedObjectArray counts in int and doubles; the links need two values per pair.
  constexpr std::uint64_t limit = std::uint64_t{1} << 30;
  if (new_size >= limit) fatal("2^30 pairs overlap, more than Bullet's pair array can hold");
  if (new_size > std::uint64_t(pairs_.capacity())) {
    const auto room = std::min(std::max(new_size, 2 * std::uint64_t(pairs_.capacity())), limit);
    require_memory(room * sizeof(btBroadphasePair));
    pairs_.reserve(int(room));
  }
  pairs_.resizeNoInitialize(int(new_size));
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
