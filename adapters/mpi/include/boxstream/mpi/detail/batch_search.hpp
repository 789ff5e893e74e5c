// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <mpi.h>

#include <boxstream/decomposition.hpp>
#include <boxstream/detector.hpp>
#include <boxstream/mpi/batch.hpp>
#include <boxstream/mpi/detail/division.hpp>
#include <boxstream/mpi/detail/packing.hpp>
#include <boxstream/mpi/detail/ranks.hpp>
#include <boxstream/mpi/detail/records.hpp>
#include <boxstream/out_of_core.hpp>

namespace boxstream::mpi::detail {

/// One search of all ranks together. Whatever may throw does so inside of Ranks::together.
template <class S>
class BatchSearch {
 public:
  BatchSearch(MPI_Comm comm, Span<const BasicAabb<S>> boxes, Span<const std::uint64_t> ids, const Options& options)
      : ranks_(comm), boxes_(boxes), ids_(ids), options_(options) {}

  Stats run(WidePairSink sink) {
    division_.emplace(divide(ranks_, boxes_, ids_, traffic_, stats_.sampled));
    const std::size_t block = boxes_in_round();
    const std::uint64_t rounds = ranks_.max((boxes_.size() + block - 1) / block);
    for (std::size_t begin = 0, round = 0; round < rounds; ++round) {
      const std::size_t end = begin + std::min(boxes_.size() - begin, block);
      distribute(begin, end);
      begin = end;
    }
    ranks_.together([&] { search(sink); });
    stats_.boxes = boxes_.size();
    stats_.received = own_.size();
    stats_.part = part_of(*division_, self());
    stats_.bytes_sent = traffic_.bytes;
    stats_.messages_sent = traffic_.messages;
    return stats_;
  }

 private:
  /// So many that what all ranks send in a round to one, or one to all, can be counted by an int.
  std::size_t boxes_in_round() const {
    const auto most = static_cast<std::size_t>(INT_MAX / ranks_.size());
    return std::clamp<std::size_t>(options_.boxes_in_round, 1, most);
  }

  /// Sends boxes from `begin` to `end` to the ranks whose parts they touch.
  void distribute(std::size_t begin, std::size_t end) {
    Parcels<Record<S>> out, in;
    ranks_.together([&] {
      in.set_ranks(ranks_.size());
      pack(begin, end, out);
    });
    exchange(ranks_, out, in, traffic_, [&](std::size_t more) {
      make_room(own_, more);
      make_room(own_ids_, more);
      make_room(before_, more);
    });
    for (const Record<S>& record : in.values) {
      own_.push_back(record.box);
      own_ids_.push_back(record.id);
      before_.push_back(division_->before(self(), record.box));
    }
  }

  /// No more than is needed in the first round, and twice as much each time in later ones.
  template <class T>
  static void make_room(std::vector<T>& values, std::size_t more) {
    const std::size_t least = values.size() + more;
    if (least > values.capacity()) values.reserve(std::max(least, 2 * values.capacity()));
  }

  void pack(std::size_t begin, std::size_t end, Parcels<Record<S>>& out) {
    Packing packing(ranks_.size());
    packing.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t before = packing.size();
      division_->for_each_touched(boxes_[i], [&](std::size_t rank) { packing.add(i - begin, rank); });
      if (packing.size() == before) ++stats_.invalid;
    }
    packing.fill(out, [&](std::size_t i) { return Record<S>{boxes_[begin + i], ids_[begin + i]}; });
  }

  std::size_t self() const { return static_cast<std::size_t>(ranks_.self()); }

  void search(WidePairSink sink) {
    if (self() >= division_->size()) return;
    std::vector<WidePair> owned;
    Detector detector({options_.executor});
    const auto deliver = [&](Span<const Pair> pairs) {
      owned.clear();
      for (const Pair pair : pairs)
        if ((before_[pair.a] & before_[pair.b]) == 0) owned.push_back(wide(pair));
      stats_.pairs += owned.size();
      return owned.empty() || sink(owned);
    };
    stats_.tests = detector.stream_pairs(Span<const BasicAabb<S>>(own_), deliver).tests;
  }

  WidePair wide(Pair pair) const {
    const auto [a, b] = std::minmax(own_ids_[pair.a], own_ids_[pair.b]);
    return {a, b};
  }

  const Ranks ranks_;
  const Span<const BasicAabb<S>> boxes_;
  const Span<const std::uint64_t> ids_;
  const Options& options_;
  Traffic traffic_;
  Stats stats_;
  std::optional<BasicDecomposition<S>> division_;
  std::vector<BasicAabb<S>> own_;  // that touch the part of this rank
  std::vector<std::uint64_t> own_ids_;
  std::vector<std::uint8_t> before_;
};

template <class S>
Stats find_pairs(MPI_Comm comm, Span<const BasicAabb<S>> boxes, Span<const std::uint64_t> ids,
                 std::vector<WidePair>& out, const Options& options) {
  out.clear();
  std::vector<WidePair> found;
  const auto take = [&](Span<const WidePair> pairs) {
    found.insert(found.end(), pairs.begin(), pairs.end());
    return true;
  };
  const Stats stats = BatchSearch<S>(comm, boxes, ids, options).run(take);
  out = std::move(found);
  return stats;
}

}  // namespace boxstream::mpi::detail
