// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <boxstream/bullet/precision.hpp>
#include <boxstream/detail/float_environment.hpp>
#include <boxstream/detector.hpp>
#include <boxstream/world.hpp>

#include "pair_store.hpp"
#include "pending_changes.hpp"
#include "proxy.hpp"
#include "rooms_choice.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Where boxes tremble: for each proxy a room, bounds for the six numbers of its box. While all boxes are in their
/// rooms, each pair of boxes that touches goes on to touch, and each pair that is apart stays so; but for watched ones,
/// those of which little is missing, which each batch compares. A box that is set and is in its room need not be looked
/// at again, and the World need not hear of it.
///
/// A box that has left its room is compared with its candidates, of which fat boxes overlap, when the next batch
/// begins. Then it gets a new room. A pair that is apart shares what lies between the two on one axis; one that touches
/// shares on each axis by how much the two overlap. Rooms of others shrink where they have to.
///
/// Rooms are in terms of what `setAabb` gets; boxes of the World are larger by `Proxy::margin`. They are integers that
/// compare as the numbers do, so that neither the floating-point environment nor a NaN matters.
class ProxyRooms {
 public:
  using Box = BasicAabb<btScalar>;
  using World = BasicWorld<btScalar>;
  using Proxies = std::vector<Proxy*>;

  bool are_open() const { return !rooms_.empty(); }
  /// Open for some proxies only, by what the World says. All else that changes has to close them.
  bool are_few() const { return !few_.empty(); }
  const Proxies& few() const { return few_; }

  bool hold(const Proxy& proxy, const btVector3& lo, const btVector3& hi) const {
    if (proxy.room >= rooms_.size() || proxy.has_left_room) return false;  // until it gets a new one
    const Room& room = rooms_[proxy.room];
    bool in = true;
    for (int d = 0; d < 3; ++d) {
      in &= room.min[d].has(lo.m_floats[d]);
      in &= room.max[d].has(hi.m_floats[d]);
    }
    return in;
  }

  /// The shape that the size of an open room's proxy is of, see ContactReach.
  const void* shape(const Proxy& proxy) const { return rooms_[proxy.room].shape; }
  /// True if its box differs from that of the World, or of the changes that this is about to get.
  bool differs(const Proxy& proxy) const { return proxy.room < rooms_.size() && rooms_[proxy.room].differs; }
  void note_passed_on(const Proxy& proxy) { rooms_[proxy.room].differs = false; }

  /// Its box has been set to one in its room, or outside of it.
  void note_move(const Proxy& proxy) { rooms_[proxy.room].differs = any_moved_ = true; }
  void note_exit(Proxy& proxy) {
    note_move(proxy);
    rooms_[proxy.room].shape = proxy.sized_shape;
    // There is room for each once: see open.
    if (!std::exchange(proxy.has_left_room, true)) exited_.push_back(proxy.position);
    if (!proxy.has_strayed && !is_near(proxy)) {
      proxy.has_strayed = true;
      strayed_.push_back(proxy.position);
    }
  }

  /// To be filled before `open`: those of the World, in the order of `live`.
  std::vector<Filter>& filters() { return filters_; }
  /// Rooms for all proxies, whose boxes the World has and whose pairs are those of `pairs`. False, and no rooms, if
  /// pairs that touch are not held or the other way round.
  bool open(const Proxies& live, PairStore& pairs);

  /// For one or some, after an update. False, and no rooms, if the World has none for one of them.
  bool open_few(World& world, Span<const ProxyId> moved);

  /// Finds the pairs that begin and end by what has moved since `open` or the last call. False if that is too much to
  /// follow, by the price of a search: rooms have to be closed.
  bool settle(const Proxies& live, RoomsChoice& choice, RoomsChoice::Price search);
  const std::vector<ProxyPair>& begun() const { return begun_; }
  const std::vector<ProxyPair>& ended() const { return ended_; }

  /// True if boxes have left their rooms. Those in their rooms may touch them.
  bool have_exits() const { return !exited_.empty(); }
  /// True if all that boxes may touch now are candidates.
  bool come_near(const Proxies& live);
  /// Calls `visit(other)` for candidates that it touches and with which no pair is held.
  template <class Visit>
  void for_each_more(const Proxies& live, const Proxy& proxy, Visit&& visit) const {
    const boxstream::detail::DefaultFloatEnvironment environment;
    const Row& row = rows_[proxy.position];
    const std::uint32_t looked_at = have_exits() ? row.size : row.watched;
    for (std::uint32_t i = 0; i < looked_at; ++i) {
      const Candidate candidate = candidates_[row.first + i];
      if (candidate.is_held) continue;
      Proxy& other = *live[candidate.other];
      if (!candidate.is_watched && !proxy.has_left_room && !other.has_left_room) continue;  // both in their rooms
      if (touch(proxy, other, proxy.margin != 0 || other.margin != 0)) visit(other);
    }
  }
  /// Outside of a batch: candidates that are held from now on.
  void note_begun(const Proxy& a, const Proxy& b);

  /// Then all boxes that differ have to go to the World.
  void close(const Proxies& live) noexcept;
  void give_back() noexcept;

  /// `refuses` is true if a filter callback may refuse pairs that group and mask accept.
  void validate(const Proxies& live, const World& world, bool refuses) const;

 private:
  using Key = std::conditional_t<sizeof(btScalar) == 4, std::int32_t, std::int64_t>;
  using Bits = std::make_unsigned_t<Key>;

  /// In the order of numbers; -0 is just below +0.
  static Key key(btScalar x) {
    const Key bits = std::bit_cast<Key>(x);
    return bits ^ ((bits >> (8 * sizeof(Key) - 1)) & all_but_sign);
  }
  static btScalar number(Key key) {
    return std::bit_cast<btScalar>(Key(key ^ ((key >> (8 * sizeof(Key) - 1)) & all_but_sign)));
  }
  static constexpr Key all_but_sign = Key(~(Key(1) << (8 * sizeof(Key) - 1)));

  /// Numbers of one sign, which lie one after the other by their bits.
  struct Range {
    Bits first, span;

    bool has(btScalar x) const { return std::bit_cast<Bits>(x) - first <= span; }
    bool are_negative() const { return (first >> (8 * sizeof(Key) - 1)) != 0; }
    Key low() const { return key(std::bit_cast<btScalar>(are_negative() ? first + span : first)); }
    Key high() const { return key(std::bit_cast<btScalar>(are_negative() ? first : first + span)); }
    /// All numbers of the sign of one.
    void start(btScalar present) {
      const bool is_negative = key(present) < 0;
      set(is_negative ? ~all_but_sign : 0, is_negative ? -1 : all_but_sign, present);
    }
    /// Between keys of one sign; only `present` if there is nothing between them.
    void set(Key low, Key high, btScalar present) {
      if (low > high) low = high = key(present);
      first = std::bit_cast<Bits>(number(low < 0 ? high : low));
      span = Bits(high) - Bits(low);
    }
  };
  /// With what else `setAabb` reads of a proxy beyond its first cache line.
  struct alignas(64) Room {
    Range min[3], max[3];
    const void* shape;
    btScalar margin;
    bool differs;

    // What bounds the box of the World from below bounds the given one by so much more, or less, than the margin:
    // rounded to the safe side, as sums are rounded too.
    void raise_min(int d, btScalar bound, const Proxy& of) { raise(min[d], bound, margin, of.m_aabbMin.m_floats[d]); }
    void lower_min(int d, btScalar bound, const Proxy& of) { lower(min[d], bound, margin, of.m_aabbMin.m_floats[d]); }
    void raise_max(int d, btScalar bound, const Proxy& of) { raise(max[d], bound, -margin, of.m_aabbMax.m_floats[d]); }
    void lower_max(int d, btScalar bound, const Proxy& of) { lower(max[d], bound, -margin, of.m_aabbMax.m_floats[d]); }

   private:
    static void raise(Range& range, btScalar bound, btScalar shift, btScalar present) {
      const Key low = shift == 0 ? key(bound) : key(bound + shift) + 1;
      if (low > range.low()) range.set(low, range.high(), present);
    }
    static void lower(Range& range, btScalar bound, btScalar shift, btScalar present) {
      const Key high = shift == 0 ? key(bound) : key(bound + shift) - 1;
      if (high < range.high()) range.set(range.low(), high, present);
    }
  };
  struct Candidate {
    std::uint32_t other : 30, is_watched : 1, is_held : 1;
  };
  struct Row {
    std::uint32_t first = 0, size = 0, room = 0, watched = 0;  // these come first
  };
  struct Watched {
    const Proxy *a, *b;
    bool is_held, has_margin;
  };

  /// As box_in_world where there is a room, without a look at more of the proxy.
  Box box_in_room(const Proxy& proxy) const {
    return PendingChanges::grown(box_of(proxy.m_aabbMin, proxy.m_aabbMax), rooms_[proxy.room].margin);
  }
  bool is_near(const Proxy& proxy) const;
  static bool touch(const Proxy& a, const Proxy& b, bool has_margin);
  Room& add_room(Proxy& proxy);
  static Box fat_box(const Box& box, btScalar went);
  void start_room(const Proxy& proxy, const Box& box);
  bool part(const Proxy& a, const Box& box_a, const Proxy& b, const Box& box_b, bool touch);
  btScalar least_clearance(const Box& a, const Box& b) const;
  void watch(Proxy& a, Proxy& b, bool is_held);
  void flip(const Proxy& a, const Proxy& b, bool is_held);
  bool refit(const Proxy& proxy);
  void add_candidates(std::uint32_t position, std::uint32_t other);
  Detector& detector() { return detector_ ? *detector_ : detector_.emplace(); }
  bool refit_strayed(const Proxies& live);
  Candidate* find(std::uint32_t of, std::uint32_t other);
  void add(std::uint32_t of, std::uint32_t other, bool held);
  void drop(std::uint32_t of, std::uint32_t other);

  std::vector<Room> rooms_;
  Proxies few_;

  // Of all proxies, by position.
  std::vector<Box> fat_boxes_;
  std::vector<Filter> filters_;
  std::vector<Row> rows_;
  std::vector<Candidate> candidates_;
  std::vector<Watched> watched_;
  std::vector<std::uint32_t> exited_;
  std::vector<std::uint32_t> strayed_;  // those that may have left their fat boxes
  std::vector<ProxyPair> begun_, ended_;
  bool any_moved_ = false;
  bool has_close_pairs_ = false;      // see least_clearance
  std::size_t refits_ = 0;            // of fat boxes, since the last batch
  std::optional<Detector> detector_;  // made when there is something for it to do
  std::vector<Pair> found_;
  std::vector<Box> boxes_;  // asked for: of all, or of those that have strayed
  std::vector<Filter> asked_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
