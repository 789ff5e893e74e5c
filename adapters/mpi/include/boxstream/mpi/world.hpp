// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <mpi.h>

#include <boxstream/aabb.hpp>
#include <boxstream/decomposition.hpp>
#include <boxstream/executor.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/mpi/detail/changes.hpp>
#include <boxstream/mpi/detail/division.hpp>
#include <boxstream/mpi/detail/packing.hpp>
#include <boxstream/mpi/detail/part_of_world.hpp>
#include <boxstream/mpi/detail/ranks.hpp>
#include <boxstream/mpi/detail/records.hpp>
#include <boxstream/mpi/error.hpp>
#include <boxstream/out_of_core.hpp>
#include <boxstream/span.hpp>

namespace boxstream::mpi {

/// What one update did on this rank.
struct WorldStats {
  std::uint64_t boxes = 0;          ///< given
  std::uint64_t changed = 0;        ///< of these, new, moved or gone since the last update; all if space was divided
  std::uint64_t received = 0;       ///< changes that concern this rank's part, from itself too
  std::uint64_t held = 0;           ///< boxes that touch the part
  std::uint64_t begun = 0;          ///< pairs
  std::uint64_t ended = 0;          ///< pairs
  std::uint64_t bytes_sent = 0;     ///< to other ranks
  std::uint64_t messages_sent = 0;  ///< that these are in
  bool divided = false;             ///< space was divided anew
  Aabb64 part{{1, 1, 1}, {-1, -1, -1}};  ///< as in Stats
};

/// Boxes of all ranks that live from frame to frame. An update reports which pairs began and which ended, each on one
/// rank: together the events of a boxstream::World of all boxes on one machine.
///
/// @par Use
/// All ranks of the communicator call `update` with the boxes that they have now, and their ids. As long as a box lives
/// it is given by the same rank, with the same id, which no other box has. One that is given no more is gone.
///
/// @par Sent
/// To each rank, the boxes that have changed and that touch its part of space, or did before. Space is divided anew,
/// and all boxes are sent, when the most boxes of a rank, over the mean, are a quarter more than after the last
/// division.
///
/// @par Order
/// Of events and pairs, on each rank, a function of the history of calls of all ranks.
///
/// @par Errors
/// As of stream_pairs. After one, on any rank, all begins anew: at the next update all pairs begin.
///
/// @par Memory
/// A boxstream::World of the boxes that touch the part, and some 80 bytes more for each; the boxes given, with their
/// ids; and, during an update, what travels.
///
/// @par Threads
/// Exclusive access.
///
/// There are no filters and no queries; boxes do not change the rank that gives them.
template <class S>
class BasicWorld {
 public:
  using Box = BasicAabb<S>;

  /// On each rank of `comm`, which must outlive it. `executor` as in boxstream::WorldOptions.
  explicit BasicWorld(MPI_Comm comm, Executor* executor = nullptr) : ranks_(comm), part_(executor) {}

  WorldStats update(Span<const Box> boxes, Span<const std::uint64_t> ids) {
    try {
      return follow(boxes, ids);
    } catch (...) {
      given_.clear();
      part_.clear();
      division_.reset();
      throw;
    }
  }

  /// Pairs of ids, a < b, that began, and ended, in the last update. Valid until the next one.
  Span<const WidePair> begun() const { return part_.begun(); }
  Span<const WidePair> ended() const { return part_.ended(); }

  /// The pairs that are this rank's at present. A pair that lasts may become another's. Stops when the visitor returns
  /// false.
  void for_each_pair(FunctionRef<bool(WidePair)> visit) const {
    if (division_) part_.for_each_pair(*division_, self(), visit);
  }

 private:
  using Division = std::optional<BasicDecomposition<S>>;

  WorldStats follow(Span<const Box> boxes, Span<const std::uint64_t> ids) {
    WorldStats stats;
    detail::Traffic traffic;
    Division next;
    stats.divided = !division_ || is_uneven();
    std::uint64_t sampled = 0;
    if (stats.divided) next.emplace(detail::divide(ranks_, boxes, ids, traffic, sampled));
    const BasicDecomposition<S>& now = next ? *next : *division_;
    const BasicDecomposition<S>& before = division_ ? *division_ : now;

    detail::Parcels<detail::Change<S>> out, in;
    ranks_.together([&] {
      if (boxes.size() != ids.size()) throw std::invalid_argument("as many ids as boxes are needed");
      const auto changes = given_.changes(boxes, ids, stats.divided);
      stats.changed = changes.size();
      pack(changes, before, now, out);
      in.set_ranks(ranks_.size());
    });
    detail::exchange(ranks_, out, in, traffic, [](std::size_t) {});
    ranks_.together([&] {
      part_.update(in.values, before, now, self());
      given_.keep(boxes, ids);
    });
    if (next) division_ = std::move(next);
    if (stats.divided) even_load_ = load();

    stats.boxes = boxes.size();
    stats.received = in.values.size();
    stats.held = part_.size();
    stats.begun = begun().size();
    stats.ended = ended().size();
    stats.bytes_sent = traffic.bytes;
    stats.messages_sent = traffic.messages;
    stats.part = detail::part_of(*division_, self());
    return stats;
  }

  /// A change concerns ranks whose part the box touched, and those whose part it touches.
  void pack(const std::vector<detail::Change<S>>& changes, const BasicDecomposition<S>& before,
            const BasicDecomposition<S>& now, detail::Parcels<detail::Change<S>>& out) const {
    detail::Packing packing(ranks_.size());
    std::vector<std::size_t> touched;
    const auto add = [&](std::size_t rank) {
      if (std::find(touched.begin(), touched.end(), rank) == touched.end()) touched.push_back(rank);
    };
    for (std::size_t i = 0; i < changes.size(); ++i) {
      touched.clear();
      before.for_each_touched(changes[i].before, add);
      now.for_each_touched(changes[i].now, add);
      for (const std::size_t rank : touched) packing.add(i, rank);
    }
    packing.fill(out, [&](std::size_t i) { return changes[i]; });
  }

  /// The most boxes of a rank over the mean, in 1024ths.
  std::uint64_t load() const {
    const std::uint64_t most = ranks_.max(part_.size()), all = ranks_.sum(part_.size());
    return all == 0 ? 1024 : most * static_cast<std::uint64_t>(ranks_.size()) * 1024 / all;
  }
  bool is_uneven() const { return load() * 4 > even_load_ * 5; }

  std::size_t self() const { return static_cast<std::size_t>(ranks_.self()); }

  detail::Ranks ranks_;
  detail::Given<S> given_;
  detail::PartOfWorld<S> part_;
  Division division_;
  std::uint64_t even_load_ = 1024;
};

using World = BasicWorld<float>;
using World64 = BasicWorld<double>;

}  // namespace boxstream::mpi
