// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <boxstream/bullet/precision.hpp>
#include <boxstream/detail/float_environment.hpp>
#include <boxstream/world.hpp>

#include "lanes.hpp"
#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// What is near to proxies of which pairs are asked for within moves, so that most moves need no search.
///
/// Each proxy has a fat box, within which its box may move; it leads the way that the proxy goes. Two proxies of which
/// fat boxes touch are neighbours, if one of them asks for its pairs. So all that an asking proxy touches is among its
/// neighbours. Of a proxy that has left its fat box they are found anew, by the next question.
class Surroundings {
 public:
  using Box = BasicAabb<btScalar>;

  bool are_kept() const { return index_.has_value(); }

  /// A question that could not be answered, as they are not kept. True if it is time to keep them.
  bool note_search(std::size_t proxies);
  /// For all that are live `note_created` has to follow.
  void begin(std::size_t proxies);
  /// `box` is that of the World, here and below.
  void note_created(Proxy& proxy, const Box& box);
  void note_destroyed(Proxy& proxy) noexcept;
  void note_move(Proxy& proxy, const Box& box) {
    const boxstream::detail::DefaultFloatEnvironment environment;
    bounds_[proxy.row] = bounds_of(box);
    const Row& row = rows_[proxy.row];
    if (!row.has_strayed() && !holds(row.fat, box)) note_strayed(proxy.row);
  }

  /// Calls `visit(other)` for what the proxy touches and `settled` does not, if it is valid; but not where it has
  /// returned true before, as it does where a pair is held, and the pair has not ended since.
  template <class Visit>
  void for_each_more(Proxy& proxy, const Box& settled, Visit&& visit) {
    settle(proxy);
    Row& row = rows_[proxy.row];
    if (std::exchange(row.epoch, epoch_) != epoch_) row.held = 0;
    const std::size_t count = find_touching(row, bounds_[proxy.row], settled);
    for (std::size_t i = 0; i < count; ++i)
      if (visit(*rows_[row.near[found_[i]]].proxy)) std::swap(row.near[found_[i]], row.near[row.held++]);
  }
  void note_ended(const Proxy& a, const Proxy& b) noexcept;
  /// Any pairs may have ended.
  void forget_held() { ++epoch_; }

  /// By the boxes that were noted.
  bool touch(const Proxy& a, const Proxy& b) const { return touch(bounds_[a.row], bounds_[b.row]); }

  /// No longer kept if questions have been too few to pay for them, or neighbours are too many.
  void note_batch();
  /// No longer kept if neighbours are too many. Before a question, for there may be many between two batches.
  void give_up_crowd() noexcept;
  /// Gives all memory back.
  void forget() noexcept;

  void validate(const std::vector<Proxy*>& live, const BasicWorld<btScalar>& world) const;

 private:
  using Index = BasicWorld<btScalar>;
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  /// A box that is compared with others by a few instructions.
  struct Bounds {
    Bounds() = default;
    explicit Bounds(const Box& box)
        : low{box.min[0], box.min[1], box.min[2], 0}, high{box.max[0], box.max[1], box.max[2], 0} {}

    /// Touches nothing.
    static Bounds nowhere() {
      constexpr btScalar nan = std::numeric_limits<btScalar>::quiet_NaN();
      return Bounds(Box{{nan, nan, nan}, {nan, nan, nan}});
    }

    Box box() const { return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}; }

    Lanes low, high;
  };

  struct Row {
    Box fat;
    btScalar center[3] = {};  // of the box, when the fat one was made
    std::uint64_t stamp = 0;  // see find_neighbours
    bool asks = false;
    std::uint32_t strayed_at = none;  // in `strayed_`
    bool has_moved = false;           // its fat box is wider than the box
    std::uint32_t held = 0;           // of the neighbours: the first ones, with which a pair is held, in this epoch
    std::uint64_t epoch = 0;
    Proxy* proxy = nullptr;  // null if the row is free
    ProxyId in_index;
    std::vector<std::uint32_t> near;  // rows

    bool has_strayed() const { return strayed_at != none; }
  };

  /// False for invalid ones too.
  static bool holds(const Box& fat, const Box& box) {
    bool in = true;
    for (int d = 0; d < 3; ++d)
      in = in & (fat.min[d] <= box.min[d]) & (box.min[d] <= box.max[d]) & (box.max[d] <= fat.max[d]);
    return in;
  }
  static Bounds bounds_of(const Box& box) { return is_valid(box) ? Bounds(box) : Bounds::nowhere(); }

  static bool touch(const Bounds& a, const Bounds& b) { return !has_any(~((a.low <= b.high) & (b.low <= a.high))); }
  /// Places of neighbours, to `found_`; returns how many.
  std::size_t find_touching(const Row& row, const Bounds& box, const Box& settled);
  void note_strayed(std::uint32_t row) {
    rows_[row].strayed_at = std::uint32_t(strayed_.size());
    strayed_.push_back(row);  // there is room for each once
  }
  /// Before a question.
  void settle(Proxy& proxy);
  void refit(std::uint32_t row);
  void find_neighbours(std::uint32_t row);
  /// Only from the neighbours of `row`.
  void unlink(std::uint32_t row, std::uint32_t other) noexcept;
  void note_not_held(Row& row, std::uint32_t other) noexcept;

  std::optional<Index> index_;  // of fat boxes; none while they are not kept
  std::vector<Row> rows_;
  std::vector<Bounds> bounds_;  // of boxes of the World, by row
  std::vector<std::uint32_t> free_rows_;
  std::vector<std::uint32_t> strayed_;
  std::vector<std::uint32_t> found_;
  std::uint64_t stamp_ = 0, epoch_ = 0;
  std::size_t asking_ = 0;    // rows
  std::size_t links_ = 0;     // from a row to a neighbour
  std::size_t longest_ = 0;   // of the neighbours of a row, ever
  std::size_t searches_ = 0;  // while they are not kept
  std::size_t questions_ = 0, refits_ = 0;
  unsigned idle_batches_ = 0, failures_ = 0;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
