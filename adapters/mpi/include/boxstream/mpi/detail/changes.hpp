// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/detail/float_environment.hpp>
#include <boxstream/span.hpp>

namespace boxstream::mpi::detail {

/// The box of an id in the last frame and in this one; where there is none, an invalid box.
template <class S>
struct Change {
  std::uint64_t id;
  BasicAabb<S> before, now;
};

template <class S>
inline constexpr BasicAabb<S> no_box{{1, 1, 1}, {-1, -1, -1}};

/// What a rank gave in the last frame.
template <class S>
class Given {
 public:
  /// How that differs from what it gives now; with `all`, boxes that are where they were as well.
  std::vector<Change<S>> changes(Span<const BasicAabb<S>> boxes, Span<const std::uint64_t> ids, bool all) const {
    const boxstream::detail::DefaultFloatEnvironment environment;
    std::vector<Change<S>> changes;
    const auto add = [&](std::uint64_t id, const BasicAabb<S>& before, const BasicAabb<S>& now) {
      if (all || before != now) changes.push_back({id, before, now});
    };
    if (std::equal(ids.begin(), ids.end(), ids_.begin(), ids_.end())) {
      for (std::size_t i = 0; i < ids.size(); ++i) add(ids[i], boxes_[i], boxes[i]);
      return changes;
    }
    const std::vector<std::size_t> old_order = order_of(ids_), order = order_of(ids);
    for (auto i = order.begin(), j = old_order.begin(); i != order.end() || j != old_order.end();) {
      const bool is_old = j != old_order.end() && (i == order.end() || ids_[*j] <= ids[*i]);
      const bool is_new = i != order.end() && (j == old_order.end() || ids[*i] <= ids_[*j]);
      const std::uint64_t id = is_new ? ids[*i] : ids_[*j];
      const BasicAabb<S>& now = is_new ? boxes[*i++] : no_box<S>;
      add(id, is_old ? boxes_[*j++] : no_box<S>, now);
    }
    return changes;
  }

  void keep(Span<const BasicAabb<S>> boxes, Span<const std::uint64_t> ids) {
    boxes_.assign(boxes.begin(), boxes.end());
    ids_.assign(ids.begin(), ids.end());
  }
  void clear() {
    boxes_.clear();
    ids_.clear();
  }

 private:
  static std::vector<std::size_t> order_of(Span<const std::uint64_t> ids) {
    std::vector<std::size_t> order(ids.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
    return order;
  }

  std::vector<BasicAabb<S>> boxes_;
  std::vector<std::uint64_t> ids_;
};

}  // namespace boxstream::mpi::detail
