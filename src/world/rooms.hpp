// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <boxstream/detail/float_environment.hpp>

#include "base/thresholds.hpp"
#include "base/tolerance.hpp"
#include "world/state/pairs.hpp"
#include "world/state/proxies.hpp"

namespace boxstream::detail {

/// Where few boxes move, and the same ones again and again: for each of these a room, in which its box may move without
/// a pair beginning or ending while nothing else changes. An update in which all that changed has stayed in its room is
/// over then.
///
/// A room bounds each of the six numbers of the box on both sides: it stays apart from all boxes that it is apart from,
/// and goes on to touch those with which it is held as a pair. Rooms say nothing once anything else changes, so that
/// every other update forgets them.
template <class S>
class Rooms {
 public:
  using Box = BasicAabb<S>;

  static constexpr std::size_t most = 8;  // rooms

  void forget() noexcept { count_ = 0; }

  /// True if all that has changed are boxes that are in their rooms.
  bool hold(const ProxyTable<S>& proxies) {
    const Span<const std::uint32_t> dirty = proxies.dirty();
    if (dirty.size() > count_) return false;
    const DefaultFloatEnvironment environment;
    for (std::size_t i = 0; i < dirty.size(); ++i) {
      const std::uint32_t rank = dirty[i];
      const Room* const room = rooms_[i].rank == rank ? rooms_ + i : room_of(rank);
      if (room == nullptr || proxies.flags(rank) != ProxyTable<S>::moved || !room->holds(proxies.box(rank)))
        return false;
    }
    ++lasted_;
    return true;
  }

  /// Before an update that they do not hold, which forgets them.
  struct Left {
    bool were_there = false;
    unsigned lasted = 0;       ///< updates that they have held
    bool moves_again = false;  ///< the same few boxes as in the last update of this kind
  };
  Left leave(const ProxyTable<S>& proxies) {
    const Span<const std::uint32_t> dirty = proxies.dirty();
    Left left{count_ != 0, lasted_, false};
    count_ = lasted_ = 0;
    if (dirty.size() > most) {
      last_count_ = 0;
      return left;
    }
    left.moves_again = !dirty.empty() && dirty.size() == last_count_ && std::equal(dirty.begin(), dirty.end(), last_);
    last_count_ = dirty.size();
    std::copy_n(dirty.begin(), last_count_, last_);
    return left;
  }

  /// After that update, if boxes move again. False if there is no room for all of these. `visit_near(box, visit)` calls
  /// `visit(rank)` for each proxy whose box touches `box`, and perhaps for others.
  template <class VisitNear>
  bool fit(const ProxyTable<S>& proxies, const HeldPairs& held, VisitNear&& visit_near) {
    const DefaultFloatEnvironment environment;
    for (; count_ < last_count_; ++count_) {
      const std::uint32_t rank = last_[count_];
      Room& room = rooms_[count_];
      if (!proxies.is_valid(rank) || !room.fit(proxies.box(rank), rank)) return give_up();
      const Box widest = room.around;
      bool is_good = true;
      visit_near(widest, [&](std::uint32_t other) {
        is_good = is_good && (other == rank || (!moves(other) && room.mind(proxies, held, other)));
      });
      for (std::size_t i = 0; i < count_; ++i) is_good = is_good && !overlap_by_keys(rooms_[i].around, room.around);
      if (!is_good) return give_up();
    }
    return true;
  }

  std::size_t count() const { return count_; }

  /// To a caller that looks after the room itself: its bounds, as BasicWorld::room has them. False if there is none.
  bool lend(std::uint32_t rank, Box& outer, Box& inner) {
    const Room* const room = std::find_if(rooms_, rooms_ + count_, [&](const Room& r) { return r.rank == rank; });
    if (room == rooms_ + count_) return false;
    lasted_ = thresholds.rooms_pay;
    inner = room->inside;
    for (int d = 0; d < 3; ++d) {
      outer.min[d] = next_to(room->around.min[d], 1);
      outer.max[d] = next_to(room->around.max[d], -1);
    }
    return true;
  }

 private:
  struct Room;

  bool give_up() noexcept {
    forget();
    return false;
  }

  const Room* room_of(std::uint32_t rank) const {
    const Room* const room = std::find_if(rooms_, rooms_ + count_, [&](const Room& r) { return r.rank == rank; });
    return room == rooms_ + count_ ? nullptr : room;
  }
  bool moves(std::uint32_t rank) const { return std::find(last_, last_ + last_count_, rank) != last_ + last_count_; }

  struct Room {
    std::uint32_t rank;
    Box around;  // strictly inside of which the box is
    Box inside;  // min is an upper bound of the box's, max a lower one

    /// For a box that is alone, as far as it is likely to move soon.
    bool fit(const Box& box, std::uint32_t of) {
      rank = of;
      for (int d = 0; d < 3; ++d) {
        const S side = box.max[d] - box.min[d], center = box.min[d] + side / 2;
        around.min[d] = box.min[d] - side / 2;
        around.max[d] = box.max[d] + side / 2;
        inside.min[d] = inside.max[d] = center;
        if (!(around.min[d] < box.min[d] && box.max[d] < around.max[d])) return false;  // flat, or too far out
        if (!(box.min[d] <= center && center <= box.max[d])) return false;
      }
      return true;
    }

    bool holds(const Box& box) const {
      for (int d = 0; d < 3; ++d)
        if (!(around.min[d] < box.min[d] && box.min[d] <= inside.min[d] && inside.max[d] <= box.max[d] &&
              box.max[d] < around.max[d]))
          return false;
      return true;
    }

    /// Bounds the room by another box, at rest. False if there is no room.
    bool mind(const ProxyTable<S>& proxies, const HeldPairs& held, std::uint32_t other) {
      if (!proxies.is_valid(other)) return true;
      const Box& box = proxies.box(rank);
      const Box& beside = proxies.box(other);
      if (held.contains(pair_key(rank, other))) {
        for (int d = 0; d < 3; ++d) {
          inside.min[d] = std::min(inside.min[d], beside.max[d]);
          inside.max[d] = std::max(inside.max[d], beside.min[d]);
        }
        return true;
      }
      if (!accepts(proxies.filter(rank), proxies.filter(other))) return true;
      int axis = -1;
      S widest = 0;
      for (int d = 0; d < 3; ++d) {
        const S gap = std::max(beside.min[d] - box.max[d], box.min[d] - beside.max[d]);
        if (gap > widest) {
          widest = gap;
          axis = d;
        }
      }
      if (axis < 0) return false;  // refused, so that it is asked about whenever the box moves
      if (beside.min[axis] > box.max[axis])
        around.max[axis] = std::min(around.max[axis], beside.min[axis]);
      else
        around.min[axis] = std::max(around.min[axis], beside.max[axis]);
      return true;
    }
  };

  Room rooms_[most];
  std::size_t count_ = 0;
  std::uint32_t last_[most];  // that changed before the last update without rooms
  std::size_t last_count_ = 0;
  unsigned lasted_ = 0;  // updates that these rooms have held
};

}  // namespace boxstream::detail
