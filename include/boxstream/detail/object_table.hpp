// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/detail/place_table.hpp>
#include <boxstream/detector.hpp>
#include <boxstream/span.hpp>

namespace boxstream::detail {

/// Bit for bit.
template <class S>
inline bool is_same(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  constexpr std::size_t words = sizeof(a) / sizeof(std::uint64_t);
  std::uint64_t x[words], y[words], different = 0;
  std::memcpy(x, &a, sizeof(x));
  std::memcpy(y, &b, sizeof(y));
  for (std::size_t i = 0; i < words; ++i) different |= x[i] ^ y[i];
  return different == 0;
}

/// Objects in order of registration, with the boxes last read, and a log of changes by which views of the table are
/// brought up to date. Objects are addresses, never dereferenced. A place is an index into the table. Removed objects
/// leave gaps, unless they are taken out.
template <class S>
class ObjectTable {
 public:
  using Box = BasicAabb<S>;
  using Place = std::uint32_t;

  static constexpr Place none = PlaceTable::none;

  std::size_t size() const { return size_; }
  /// All places are below this.
  Place places() const { return static_cast<Place>(objects_.size()); }
  Place find(const void* object) const { return object == nullptr ? none : place_table_.find(object, objects_); }

  /// Null at a gap.
  void* object(Place place) const { return objects_[place]; }
  const Box& box(Place place) const { return boxes_[place]; }
  Filter filter(Place place) const { return filters_[place]; }
  bool is_static(Place place) const { return is_static_[place] != 0; }
  const std::vector<Box>& boxes() const { return boxes_; }
  /// Empty while all filters are the default one.
  Span<const Filter> special_filters() const {
    return has_filters_ ? Span<const Filter>(filters_) : Span<const Filter>();
  }

  /// Makes room for `more` objects. May throw; other changes of the table need room and do not throw.
  void reserve(std::size_t more) {
    const std::size_t needed = objects_.size() + more, half_more = room_ + room_ / 2;
    if (needed <= room_) return;
    const std::size_t room = needed > half_more ? needed : half_more;
    for_each_array([room](auto& of) { of.reserve(room); });
    place_table_.reserve(room, objects_);
    changes_.reserve(most_changes(room));
    room_ = room;
  }

  /// Gives back what the objects that are here do not need. Views have to be made anew. May throw, and has then done
  /// nothing.
  void shrink_to_fit() {
    std::vector<Place> changes;
    if (!objects_.empty()) changes.reserve(most_changes(objects_.size()));
    place_table_.shrink(objects_.size(), objects_);
    for_each_array([](auto& of) { of.shrink_to_fit(); });
    forget_changes();
    changes_.swap(changes);
    room_ = objects_.size();
  }

  /// The object is not registered yet. Needs room.
  void add(void* object, const Box& box, Filter filter, bool is_static) noexcept {
    const Place place = places();
    objects_.push_back(object);
    boxes_.push_back(box);
    filters_.push_back(filter);
    is_static_.push_back(is_static);
    place_table_.insert(place, objects_);
    ++size_;
    has_filters_ |= !is_plain(filter);
    note(place);
  }

  void remove(Place place) noexcept {
    constexpr S inf = std::numeric_limits<S>::infinity();
    place_table_.erase(place, objects_);
    --size_;
    objects_[place] = nullptr;
    boxes_[place] = {{inf, inf, inf}, {-inf, -inf, -inf}};  // pairs with nothing
    note(place);
  }

  /// Removes an object and closes all gaps. Places change, and views have to be made anew. For few objects, as all that
  /// follow are moved.
  void take_out(Place place) noexcept {
    place_table_.erase(place, objects_);
    objects_[place] = nullptr;
    Place count = 0;
    for (Place from = 0; from < places(); ++from) {
      if (objects_[from] == nullptr) continue;
      if (count != from) {
        place_table_.rename(from, count, objects_);
        for_each_array([&](auto& of) { of[count] = of[from]; });
      }
      ++count;
    }
    for_each_array([count](auto& of) { of.erase(of.begin() + static_cast<std::ptrdiff_t>(count), of.end()); });
    size_ = count;
    forget_changes();
  }

  /// False if it is the box that it had, bit for bit.
  bool set_box(Place place, const Box& box) noexcept {
    if (is_same(boxes_[place], box)) return false;
    boxes_[place] = box;
    note(place);
    return true;
  }

  void set_filter(Place place, Filter filter, bool is_static) noexcept {
    filters_[place] = filter;
    is_static_[place] = is_static;
    has_filters_ |= !is_plain(filter);
    note(place);
  }

  void clear() noexcept {
    for_each_array([](auto& of) { of.clear(); });
    place_table_.renew(objects_);
    size_ = 0;
    forget_changes();
    has_filters_ = false;
  }

  /// Skips one number, so that views have to be made anew, and nothing is known any more of what was so at an earlier
  /// change.
  void forget_changes() noexcept {
    dropped_changes_ += changes_.size() + 1;
    changes_.clear();
  }

  std::size_t gaps() const { return objects_.size() - size_; }

  /// The places that there are after `compact`, by those before it; `none` for gaps that are closed. Gaps among the
  /// changes from number `seen` on stay, for views have yet to take them out. May throw.
  std::vector<Place> compacted(std::uint64_t seen) const {
    std::vector<Place> to(places(), 0);
    for (std::uint64_t i = seen < first_change() ? first_change() : seen; i != last_change(); ++i)
      if (change(i) != none) to[change(i)] = 1;
    Place next = 0;
    for (Place place = 0; place < places(); ++place)
      to[place] = objects_[place] != nullptr || to[place] != 0 ? next++ : none;
    return to;
  }

  /// Closes gaps. Views have to follow.
  void compact(const std::vector<Place>& to) noexcept {
    Place count = 0;
    for (Place from = 0; from < places(); ++from) {
      if (to[from] == none) continue;
      for_each_array([&](auto& of) { of[to[from]] = of[from]; });
      ++count;
    }
    for_each_array([count](auto& of) { of.resize(count); });
    place_table_.renew(objects_);
    for (Place& place : changes_)
      if (place != none) place = to[place];
  }

  /// The log: entries [first_change, last_change), `none` for those of places that are no more. Numbers are never used
  /// again. A view that has missed older entries must read the whole table.
  std::uint64_t first_change() const { return dropped_changes_; }
  std::uint64_t last_change() const { return dropped_changes_ + changes_.size(); }
  Place change(std::uint64_t number) const { return changes_[number - dropped_changes_]; }

  /// Throws std::logic_error naming the first broken invariant.
  void validate() const;

 private:
  static bool is_plain(Filter filter) { return filter.group == Filter{}.group && filter.mask == Filter{}.mask; }

  /// Of what is kept by place.
  template <class Do>
  void for_each_array(Do&& of) {
    of(objects_);
    of(boxes_);
    of(filters_);
    of(is_static_);
  }

  /// Views that have missed half as many have fallen behind: for them it is as quick to read the whole table.
  static constexpr std::size_t most_changes(std::size_t room) { return room / 2 + 32; }

  /// The older half makes room.
  void note(Place place) noexcept {
    if (changes_.size() == changes_.capacity()) {
      const std::size_t half = changes_.size() / 2;
      changes_.erase(changes_.begin(), changes_.begin() + static_cast<std::ptrdiff_t>(half));
      dropped_changes_ += half;
    }
    changes_.push_back(place);
  }

  std::vector<void*> objects_;
  std::vector<Box> boxes_;
  std::vector<Filter> filters_;
  std::vector<std::uint8_t> is_static_;
  PlaceTable place_table_;
  std::size_t size_ = 0;
  std::size_t room_ = 0;  // objects for which all arrays have room
  std::vector<Place> changes_;
  std::uint64_t dropped_changes_ = 1;
  bool has_filters_ = false;
};

}  // namespace boxstream::detail
