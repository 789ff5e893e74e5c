// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/detector.hpp>
#include <boxstream/span.hpp>
#include <boxstream/world.hpp>

#include "base/first_block.hpp"
#include "base/keys.hpp"
#include "base/reserve.hpp"
#include "base/thresholds.hpp"
#include "world/state/compare.hpp"
#include "world/state/few_boxes.hpp"

namespace boxstream::detail {

/// Closed overlap of two valid boxes, whatever the floating-point environment does to denormal numbers.
template <class S>
bool overlap_by_keys(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  for (int d = 0; d < 3; ++d)
    if (order_key(a.min[d]) > order_key(b.max[d]) || order_key(b.min[d]) > order_key(a.max[d])) return false;
  return true;
}

/// The proxies of one World as dense arrays in order of creation, so that the index ("rank") of a proxy is its place in
/// that order and the arrays go to the Detector as they are. A destroyed proxy stays behind as a tombstone with an
/// invalid box, because the pairs that end with it still need its id; compaction drops tombstones and keeps the order.
///
/// Slots give proxies names that survive compaction. Ranks that changed since the last update are listed in `dirty`.
template <class S>
class ProxyTable {
 public:
  using Box = BasicAabb<S>;

  static constexpr std::uint32_t none = ~std::uint32_t{0};

  /// Why a rank is on the list of dirty ones, or (the last two, which outlive the list) what it is.
  enum Flag : std::uint8_t { moved = 1, refiltered = 2, dead = 4, invalid = 8 };

  /// Ids start at `first_generation`; a slot that has used up all generations is retired, so that no id ever returns.
  explicit ProxyTable(std::uint32_t first_generation = 1) : first_generation_(first_generation) {}

  /// Inside out on every axis, so that no comparison with it can succeed and no NaN is involved.
  static constexpr Box inert_box() {
    constexpr S inf = std::numeric_limits<S>::infinity();
    return {{inf, inf, inf}, {-inf, -inf, -inf}};
  }

  /// Room for `more` proxies: their creation cannot throw. Grows geometrically.
  void reserve(std::size_t more) {
    if (more > none - 1 - boxes_.size()) throw std::length_error("boxstream: more than 2^32 - 2 proxies");
    reserve_more(boxes_, more);
    reserve_more(filters_, more);
    reserve_more(users_, more);
    reserve_more(ids_, more);
    reserve_more(flags_, more);
    reserve_more(slots_, new_slots(more));
    dirty_.resize(boxes_.capacity());
    if (boxes_.capacity() > thresholds.most_dead) remap_.reserve(boxes_.capacity());  // see reserve_to_compact
    free_slots_.reserve(slots_.capacity());
    if (!few_.is_kept()) return;
    if (boxes_.size() + more > FewBoxes<S>::most)
      few_.drop();
    else
      few_.keep(boxes_, boxes_.size() + more);
  }

  /// Gives back what room there is for more. May throw, and has then given back a part.
  void shrink_to_fit() {
    few_.shrink_to_fit(boxes_);
    if (slots_.capacity() <= least_room) return;
    const auto fit = [](auto&... vectors) { (vectors.shrink_to_fit(), ...); };
    fit(boxes_, filters_, users_, ids_, flags_, slots_);
    const auto leave_room = [](Column<std::uint32_t>& vector, std::size_t size) {
      Column<std::uint32_t> smaller(vector.get_allocator());
      smaller.reserve(size);
      smaller.insert(smaller.end(), vector.begin(), vector.end());
      vector.swap(smaller);
    };
    remap_.clear();
    Column<std::uint32_t> dirty(boxes_.capacity(), dirty_.get_allocator());
    std::copy_n(dirty_.begin(), dirty_count_, dirty.begin());
    dirty_.swap(dirty);
    leave_room(remap_, boxes_.capacity());
    leave_room(free_slots_, slots_.capacity());
  }

  ProxyId create(const Box& box, Filter filter, std::uint64_t user) noexcept {
    assert(boxes_.size() < boxes_.capacity() && dirty_count_ < dirty_.size());
    assert(!free_slots_.empty() || slots_.size() < slots_.capacity());
    const auto rank = static_cast<std::uint32_t>(boxes_.size());
    std::uint32_t slot;
    if (free_slots_.empty()) {
      slot = static_cast<std::uint32_t>(slots_.size());
      slots_.push_back({rank, first_generation_});
    } else {
      slot = free_slots_.back();
      free_slots_.pop_back();
      slots_[slot].rank = rank;
    }
    const ProxyId id{slot, slots_[slot].generation};
    const BoxKeys<S> keys(box);
    const bool valid = keys.are_valid();
    boxes_.push_back(box);
    filters_.push_back(filter);
    users_.push_back(user);
    ids_.push_back(id);
    flags_.push_back(valid ? moved : moved | invalid);
    dirty_[dirty_count_++] = rank;
    ++moved_count_;
    invalid_count_ += !valid;
    special_filters_ += !is_default(filter);
    if (few_.is_kept()) set_few(rank, keys, valid);
    return id;
  }

  void destroy(std::uint32_t rank) noexcept {
    assert(rank < boxes_.size() && !is_dead(rank) && free_slots_.size() < free_slots_.capacity());
    const std::uint32_t name = ids_[rank].slot;
    Slot& slot = slots_[name];
    slot.rank = none;
    ++slot.generation;
    if (slot.generation != 0) free_slots_.push_back(name);
    invalid_count_ -= (flags_[rank] & invalid) != 0;
    special_filters_ -= !is_default(filters_[rank]);
    moved_count_ -= (flags_[rank] & moved) != 0;
    mark(rank, dead);
    boxes_[rank] = inert_box();
    filters_[rank] = Filter{};
    ++dead_count_;
    if (few_.is_kept()) few_.set_inert(rank);
  }

  /// Back to the state of a new table; memory is kept.
  void clear() noexcept {
    boxes_.clear();
    filters_.clear();
    users_.clear();
    ids_.clear();
    flags_.clear();
    slots_.clear();
    free_slots_.clear();
    dirty_count_ = 0;
    few_.keep({}, 0);
    few_.cut(0);
    dead_count_ = kept_count_ = 0;
    moved_count_ = invalid_count_ = special_filters_ = 0;
    has_other_flags_ = false;
  }

  /// False if the new box has the bounds of the old one (whatever the signs of zeros), so that nothing depends on it.
  bool move(std::uint32_t rank, const Box& box) noexcept {
    Box& old = boxes_[rank];
    const Difference difference = compare(old, box);
    if (difference == Difference::none) return false;
    std::uint8_t& flags = flags_[rank];
    const BoxKeys<S> keys(box);
    const bool now_valid = keys.are_valid();
    old = box;
    if (few_.is_kept()) set_few(rank, keys, now_valid);
    if ((flags & invalid) != 0 || !now_valid) {
      const bool was_valid = (flags & invalid) == 0;
      if (!was_valid && !now_valid) return false;
      flags_[rank] ^= invalid;
      invalid_count_ += was_valid ? 1 : -1;
    } else if (difference == Difference::zeros) {
      return false;
    }
    moved_count_ += (flags & moved) == 0;
    mark(rank, moved);
    return true;
  }

  /// As `move` for each live id, `on_move(slot)` being called for each box that changed. Returns how many were live.
  /// Ids in order of creation lie in `ids_` as they are given. Then they are looked up, and boxes at rest compared, in
  /// runs: at the speed of memory.
  template <class OnMove>
  std::size_t move(Span<const ProxyId> ids, Span<const Box> boxes, OnMove&& on_move) noexcept {
    std::size_t live = 0;
    for (std::size_t first = 0; first < ids.size(); first += run_length) {
      const std::size_t size = std::min(run_length, ids.size() - first);
      const ProxyId* const id = ids.data() + first;
      const Box* const box = boxes.data() + first;
      const std::uint32_t r = rank(id[0]);
      if (size >= compared_group && is_run(r, id, size)) {
        live += size;
        if (std::memcmp(box, &boxes_[r], size * sizeof(Box)) == 0) continue;
        const std::size_t groups = size / compared_group;
        const auto moved_so_far = static_cast<std::uint32_t>(
            groups != 0 && move_groups(r, box, groups, on_move) ? groups * compared_group : 0);
        for (std::uint32_t i = moved_so_far; i < size; ++i)
          if (move(r + i, box[i])) on_move(id[i].slot);
      } else {
        for (std::size_t i = 0; i < size; ++i) {
          const std::uint32_t each = rank(id[i]);
          if (each == none) continue;
          ++live;
          if (move(each, box[i])) on_move(id[i].slot);
        }
      }
    }
    return live;
  }

  void set_filter(std::uint32_t rank, Filter filter) noexcept {
    Filter& old = filters_[rank];
    if (old.group == filter.group && old.mask == filter.mask) return;
    special_filters_ += is_default(old);
    special_filters_ -= is_default(filter);
    old = filter;
    mark(rank, refiltered);
  }

  /// As if its filter had changed.
  void refilter(std::uint32_t rank) noexcept {
    if (!is_dead(rank)) mark(rank, refiltered);
  }

  void set_user(std::uint32_t rank, std::uint64_t user) noexcept { users_[rank] = user; }

  /// The rank of a live proxy, or `none`.
  std::uint32_t rank(ProxyId id) const {
    if (id.slot >= slots_.size()) return none;
    const Slot& slot = slots_[id.slot];
    return slot.generation == id.generation ? slot.rank : none;
  }
  /// The rank of the live proxy in a slot, or `none`.
  std::uint32_t rank_of_slot(std::uint32_t slot) const { return slot < slots_.size() ? slots_[slot].rank : none; }

  Span<const Box> boxes() const { return boxes_; }
  /// Empty while all filters are the default one, which accepts itself.
  Span<const Filter> batch_filters() const {
    return special_filters_ == 0 ? Span<const Filter>() : Span<const Filter>(filters_);
  }
  bool has_default_filters() const { return special_filters_ == 0; }
  const Box& box(std::uint32_t rank) const { return boxes_[rank]; }
  Filter filter(std::uint32_t rank) const { return filters_[rank]; }
  std::uint64_t user(std::uint32_t rank) const { return users_[rank]; }
  ProxyId id(std::uint32_t rank) const { return ids_[rank]; }
  bool is_dead(std::uint32_t rank) const { return (flags_[rank] & dead) != 0; }
  bool is_dirty(std::uint32_t rank) const { return (flags_[rank] & any_change) != 0; }
  bool is_valid(std::uint32_t rank) const { return (flags_[rank] & (dead | invalid)) == 0; }
  std::uint8_t flags(std::uint32_t rank) const { return flags_[rank]; }

  /// True if both proxies are alive and their boxes share a point.
  bool touching(std::uint32_t a, std::uint32_t b) const {
    return is_valid(a) && is_valid(b) && overlap_by_keys(boxes_[a], boxes_[b]);
  }

  std::size_t ranks() const { return boxes_.size(); }
  std::size_t live() const { return boxes_.size() - dead_count_; }
  std::size_t tombstones() const { return dead_count_; }
  std::size_t slots() const { return slots_.size(); }
  std::uint64_t invalid_count() const { return invalid_count_; }
  std::uint64_t moved_since_update() const { return moved_count_; }
  Span<const std::uint32_t> dirty() const { return {dirty_.data(), dirty_count_}; }
  /// False if any rank may have a flag other than `moved`.
  bool has_only_moved() const { return !has_other_flags_ && invalid_count_ == 0 && dead_count_ == 0; }

  /// An update has processed all changes.
  void settle() noexcept {
    for (const std::uint32_t rank : dirty()) flags_[rank] &= dead | invalid;
    dirty_count_ = 0;
    moved_count_ = 0;
    has_other_flags_ = false;
  }

  /// True while there are few proxies, tombstones included: then their boxes are columns too. More of them become few
  /// again at three quarters of that number. May throw.
  bool keep_few() {
    constexpr std::size_t again = FewBoxes<S>::most - FewBoxes<S>::most / 4;
    if (!few_.is_kept() && ranks() <= again) few_.keep(boxes_, boxes_.size());
    return few_.is_kept();
  }
  const FewBoxes<S>& few() const { return few_; }

  /// True when dropping tombstones pays: once they are a quarter of all ranks, unless the last compaction had to keep
  /// most of them.
  bool needs_compaction() const {
    return dead_count_ > thresholds.most_dead + 2 * kept_count_ && dead_count_ > boxes_.size() / 4;
  }

  /// True if with `more` there would be too many for columns only as tombstones are counted, which are worth a
  /// compaction.
  bool crowds_few(std::size_t more) const {
    constexpr std::size_t most = FewBoxes<S>::most;
    return few_.is_kept() && boxes_.size() + more > most && live() + more <= most &&
           dead_count_ > kept_count_ + most / 16;
  }

  /// Upper bound of all slots after `more` creations.
  std::size_t slots_after(std::size_t more) const { return slots_.size() + new_slots(more); }

  /// Few proxies are compacted on request alone, so that `reserve` does not do this for them. May throw.
  void reserve_to_compact() { remap_.reserve(boxes_.size()); }
  /// Drops the tombstones for which `keep(rank)` is false, and returns the new rank of each old one (`none` if
  /// dropped).
  template <class Keep>
  Span<const std::uint32_t> compact(Keep&& keep) noexcept {
    remap_.resize(boxes_.size());
    std::uint32_t to = 0;
    for (std::uint32_t from = 0; from < boxes_.size(); ++from) {
      if (is_dead(from) && !keep(from)) {
        remap_[from] = none;
        --dead_count_;
        continue;
      }
      remap_[from] = to;
      boxes_[to] = boxes_[from];
      filters_[to] = filters_[from];
      users_[to] = users_[from];
      ids_[to] = ids_[from];
      flags_[to] = flags_[from];
      if (!is_dead(to)) slots_[ids_[to].slot].rank = to;
      ++to;
    }
    boxes_.resize(to);
    filters_.resize(to);
    users_.resize(to);
    ids_.resize(to);
    flags_.resize(to);
    std::size_t kept = 0;
    for (const std::uint32_t rank : dirty())
      if (remap_[rank] != none) dirty_[kept++] = remap_[rank];
    dirty_count_ = kept;
    kept_count_ = dead_count_;
    if (few_.is_kept()) {
      few_.load(boxes_, 0, to);
      few_.cut(to);
    }
    return remap_;
  }

  /// Throws std::logic_error naming the first broken invariant.
  void validate() const;

 private:
  struct Slot {
    std::uint32_t rank;        // `none` while the slot is free
    std::uint32_t generation;  // of the present id, or of the next one; 0: used up
  };

  enum class Difference { none, zeros, numbers };

  static constexpr std::size_t run_length = 4 * compared_group;
  static constexpr std::uint8_t any_change = moved | refiltered | dead;

  std::size_t new_slots(std::size_t more) const { return more > free_slots_.size() ? more - free_slots_.size() : 0; }

  /// True if these are the ids of the live proxies of rank `first` and up.
  bool is_run(std::uint32_t first, const ProxyId* ids, std::size_t size) const noexcept {
    if (first == none || size > ids_.size() - first) return false;
    if (std::memcmp(ids, &ids_[first], size * sizeof(ProxyId)) != 0) return false;
    std::uint8_t any = 0;
    for (std::size_t i = 0; i < size; ++i) any |= flags_[first + i];
    return (any & dead) == 0;
  }

  /// Moves whole groups of a run, unless an invalid box is involved: then it returns false and has done nothing.
  template <class OnMove>
  bool move_groups(std::uint32_t first, const Box* boxes, std::size_t groups, OnMove&& on_move) noexcept {
    std::uint64_t changed[run_length / compared_group];
    std::uint8_t any = 0;
    for (std::size_t i = 0; i < groups * compared_group; ++i) any |= flags_[first + i];
    if ((any & invalid) != 0 || !compare_groups(&boxes_[first], boxes, groups, changed)) return false;
    std::copy_n(boxes, groups * compared_group, &boxes_[first]);
    if (few_.is_kept()) few_.load(boxes_, first, first + groups * compared_group);
    for (std::size_t g = 0; g < groups; ++g) {
      const auto rank = static_cast<std::uint32_t>(first + g * compared_group);
      if (changed[g] == whole_group && mark_group(rank)) {
        for (std::uint32_t i = 0; i < compared_group; ++i) on_move(ids_[rank + i].slot);
        continue;
      }
      for (std::uint64_t left = changed[g]; left != 0; left &= left - 1) {
        const std::uint32_t each = rank + static_cast<std::uint32_t>(std::countr_zero(left)) / 6;
        moved_count_ += (flags_[each] & moved) == 0;
        mark(each, moved);
        on_move(ids_[each].slot);
      }
    }
    return true;
  }

  /// As `mark(rank, moved)` for a group; false, and nothing done, if any has a flag already.
  bool mark_group(std::uint32_t first) noexcept {
    std::uint64_t flags;
    static_assert(sizeof(flags) == compared_group);
    std::memcpy(&flags, &flags_[first], sizeof(flags));
    if (flags != 0) return false;
    std::memset(&flags_[first], moved, compared_group);
    std::iota(&dirty_[dirty_count_], &dirty_[dirty_count_] + compared_group, first);
    dirty_count_ += compared_group;
    moved_count_ += compared_group;
    return true;
  }

  /// By bits: NaNs compare like numbers, and the floating-point environment does not matter.
  static Difference compare(const Box& x, const Box& y) noexcept {
    const auto word = [](const Box& box, std::size_t i) {
      std::uint64_t bits;
      std::memcpy(&bits, reinterpret_cast<const char*>(&box) + 8 * i, sizeof(bits));
      return bits;
    };
    std::uint64_t different = 0;
    for (std::size_t i = 0; i < sizeof(Box) / 8; ++i) different |= word(x, i) ^ word(y, i);
    if (different == 0) return Difference::none;
    constexpr std::uint64_t signs = sizeof(S) == 4 ? 0x8000000080000000 : 0x8000000000000000;
    return (different & ~signs) != 0 || !differ_by_zeros(x, y) ? Difference::numbers : Difference::zeros;
  }

  static constexpr bool is_default(Filter f) { return f.group == Filter{}.group && f.mask == Filter{}.mask; }

  void set_few(std::uint32_t rank, const BoxKeys<S>& keys, bool valid) noexcept {
    if (valid)
      few_.set(rank, keys);
    else
      few_.set_inert(rank);
  }

  void mark(std::uint32_t rank, Flag flag) noexcept {
    assert(is_dirty(rank) || dirty_count_ < dirty_.size());
    if (!is_dirty(rank)) dirty_[dirty_count_++] = rank;
    flags_[rank] |= flag;
    if (flag != moved) has_other_flags_ = true;
  }

  /// As many as vectors have room for at first: see reserve_more.
  static constexpr std::size_t least_room = 16;
  using Block = FirstBlock<least_room*(sizeof(Box) + sizeof(Filter) + sizeof(std::uint64_t) + sizeof(ProxyId) + 1 +
                                       sizeof(Slot) + 2 * sizeof(std::uint32_t))>;
  template <class T>
  using Column = std::vector<T, typename Block::template Allocator<T>>;
  template <class T>
  Column<T> column() {
    return Column<T>(typename Block::template Allocator<T>(first_));
  }

  std::uint32_t first_generation_;
  Block first_;
  Column<Box> boxes_ = column<Box>();
  Column<Filter> filters_ = column<Filter>();
  Column<std::uint64_t> users_ = column<std::uint64_t>();
  Column<ProxyId> ids_ = column<ProxyId>();
  Column<std::uint8_t> flags_ = column<std::uint8_t>();
  Column<Slot> slots_ = column<Slot>();
  Column<std::uint32_t> free_slots_ = column<std::uint32_t>();
  Column<std::uint32_t> dirty_ = column<std::uint32_t>();  // as many as boxes have room for, of which
  std::size_t dirty_count_ = 0;                            // are used
  Column<std::uint32_t> remap_ = column<std::uint32_t>();
  FewBoxes<S> few_;
  std::size_t dead_count_ = 0;
  std::size_t kept_count_ = 0;  // tombstones left by the last compaction
  std::uint64_t invalid_count_ = 0;
  std::uint64_t moved_count_ = 0;
  std::uint64_t special_filters_ = 0;
  bool has_other_flags_ = false;
};

}  // namespace boxstream::detail
