// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/detector.hpp>
#include <boxstream/fcl/detail/box.hpp>
#include <boxstream/fcl/groups.hpp>

namespace boxstream::fcl::detail {

/// Where an object stands in the order of registration; gaps are left by those that went.
using Place = std::uint32_t;

/// Says of places whether the filters there go with one filter. While no object has bits of its own (`special` is
/// empty) one answer stands for all.
class GoesWith {
 public:
  GoesWith(Filter filter, Span<const Filter> special)
      : filter_(filter), special_(special), goes_with_plain_(accepts(filter, Filter{})) {}

  bool operator()(Place place) const { return special_.empty() ? goes_with_plain_ : accepts(filter_, special_[place]); }

 private:
  Filter filter_;
  Span<const Filter> special_;
  bool goes_with_plain_;
};

/// The registered objects in order of registration, with their boxes as they were last read, and a log of changes from
/// which the views of the roster learn what they have missed. Objects are told by address and never dereferenced.
template <class Object, class S>
class Roster {
 public:
  using Box = BasicAabb<S>;

  static constexpr Place none = ~Place{0};

  std::size_t size() const { return place_of_.size(); }
  /// All places are below this.
  Place places() const { return static_cast<Place>(objects_.size()); }

  Place find(const Object* object) const {
    const auto found = place_of_.find(object);
    return found == place_of_.end() ? none : found->second;
  }

  /// Null at a gap.
  Object* object(Place place) const { return objects_[place]; }
  const Box& box(Place place) const { return boxes_[place]; }
  Filter filter(Place place) const { return filters_[place]; }
  bool is_static(Place place) const { return is_static_[place] != 0; }
  const std::vector<Box>& boxes() const { return boxes_; }
  /// Empty while no object has other bits than those of a new one.
  Span<const Filter> special_filters() const {
    return has_filters_ ? Span<const Filter>(filters_) : Span<const Filter>();
  }

  /// May throw; everything else that changes the roster then does not, for so many more objects.
  void reserve(std::size_t more) {
    const std::size_t needed = objects_.size() + more, had = changes_.capacity() / 2;
    if (needed > had) {
      const std::size_t room = needed > 2 * had ? needed : 2 * had;
      objects_.reserve(room);
      boxes_.reserve(room);
      filters_.reserve(room);
      is_static_.reserve(room);
      changes_.reserve(2 * room);  // the last one, because its capacity says whether all have room
    }
    if (more > 1) place_of_.reserve(place_of_.size() + more);
  }

  /// The object is not registered yet. Needs room; may throw for the memory of the table, and has then done nothing.
  void add(Object* object, const Box& box, Filter filter, bool is_static) {
    const Place place = places();
    place_of_.emplace(object, place);
    objects_.push_back(object);
    boxes_.push_back(box);
    filters_.push_back(filter);
    is_static_.push_back(is_static);
    has_filters_ |= !is_plain(filter);
    note(place);
  }

  void remove(Place place) noexcept {
    place_of_.erase(objects_[place]);
    objects_[place] = nullptr;
    boxes_[place] = no_box<S>();
    note(place);
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
    objects_.clear();
    boxes_.clear();
    filters_.clear();
    is_static_.clear();
    place_of_.clear();
    forget_changes();
    has_filters_ = false;
  }

  std::size_t gaps() const { return objects_.size() - place_of_.size(); }

  /// Closes the gaps. Views must drop their gaps first, and take everything anew.
  void compact() noexcept {
    Place to = 0;
    for (Place from = 0; from < places(); ++from) {
      if (objects_[from] == nullptr) continue;
      objects_[to] = objects_[from];
      boxes_[to] = boxes_[from];
      filters_[to] = filters_[from];
      is_static_[to] = is_static_[from];
      place_of_.find(objects_[to])->second = to;
      ++to;
    }
    objects_.resize(to);
    boxes_.resize(to);
    filters_.resize(to);
    is_static_.resize(to);
    forget_changes();
  }

  /// The log: entries [first_change, last_change), numbered for ever. Who has not seen those before must look at all.
  std::uint64_t first_change() const { return dropped_changes_; }
  std::uint64_t last_change() const { return dropped_changes_ + changes_.size(); }
  Place change(std::uint64_t number) const { return changes_[number - dropped_changes_]; }

  void validate() const;

 private:
  static bool is_plain(Filter filter) { return filter.group == Filter{}.group && filter.mask == Filter{}.mask; }

  /// There is room for two changes an object: see `reserve`.
  void note(Place place) noexcept {
    if (changes_.size() == changes_.capacity()) forget_changes();
    changes_.push_back(place);
  }

  /// One number is skipped, so that nobody seems to be up to date.
  void forget_changes() noexcept {
    dropped_changes_ += changes_.size() + 1;
    changes_.clear();
  }

  std::vector<Object*> objects_;
  std::vector<Box> boxes_;
  std::vector<Filter> filters_;
  std::vector<std::uint8_t> is_static_;
  std::unordered_map<const Object*, Place> place_of_;
  std::vector<Place> changes_;
  std::uint64_t dropped_changes_ = 1;
  bool has_filters_ = false;
};

}  // namespace boxstream::fcl::detail
