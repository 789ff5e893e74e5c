// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <boxstream/decomposition.hpp>
#include <boxstream/mpi/detail/ranks.hpp>
#include <boxstream/mpi/detail/records.hpp>
#include <boxstream/span.hpp>

namespace boxstream::mpi::detail {

/// Space divided among the ranks, by a sample of the boxes of all of them. `sampled` is how many were in it.
template <class S>
BasicDecomposition<S> divide(const Ranks& ranks, Span<const BasicAabb<S>> boxes, Span<const std::uint64_t> ids,
                             Traffic& traffic, std::uint64_t& sampled) {
  const std::uint64_t all = ranks.sum(boxes.size());
  const auto parts = static_cast<std::size_t>(ranks.size());
  std::vector<BasicAabb<S>> sample;
  Parcels<BasicAabb<S>> samples;
  ranks.together([&] {
    if (boxes.size() != ids.size()) throw std::invalid_argument("as many ids as boxes are needed");
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (is_sampled(ids[i], all, parts)) sample.push_back(boxes[i]);
    samples.set_ranks(ranks.size());
  });
  gather(ranks, sample, samples, traffic);
  sampled = samples.values.size();
  std::optional<BasicDecomposition<S>> division;
  ranks.together([&] { division.emplace(samples.values, parts); });
  return std::move(*division);
}

/// The part of a rank, which may have none: then min > max.
template <class S>
Aabb64 part_of(const BasicDecomposition<S>& division, std::size_t rank) {
  if (rank >= division.size()) return {{1, 1, 1}, {-1, -1, -1}};
  const BasicAabb<S> box = division.bounds(rank);
  return {{box.min[0], box.min[1], box.min[2]}, {box.max[0], box.max[1], box.max[2]}};
}

}  // namespace boxstream::mpi::detail
