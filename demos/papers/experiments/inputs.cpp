// SPDX-License-Identifier: MIT
#include "papers/experiments/inputs.hpp"

#include <algorithm>
#include <stdexcept>

#include "inputs/batches.hpp"
#include "inputs/random.hpp"
#include "papers/hybrid/ranks.hpp"

namespace boxstream::papers {

namespace {

template <class T>
void deal(const std::vector<T>& from, std::vector<T>& a, std::vector<T>& b) {
  for (std::size_t i = 0; i < from.size(); ++i) (i % 2 == 0 ? a : b).push_back(from[i]);
}

/// Where all low ends are the same, draws them from 1 to n. Lengths stay.
void spread_low_ends(std::vector<Box>& boxes, std::uint64_t seed) {
  batches::Random random(~seed);
  for (int d = 0; d < 3; ++d) {
    const auto other = [&](const Box& box) { return box.projections[d].lo != boxes.front().projections[d].lo; };
    if (std::any_of(boxes.begin(), boxes.end(), other)) continue;
    for (Box& box : boxes) {
      Interval& interval = box.projections[d];
      const auto low = static_cast<std::int32_t>(random.integer(1, static_cast<std::int64_t>(boxes.size())));
      interval = {low, low + interval.hi - interval.lo};
    }
  }
}

}  // namespace

std::vector<Aabb> closed(const std::vector<Box>& boxes) {
  std::vector<Aabb> all(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (int d = 0; d < 3; ++d) {
      all[i].min[d] = static_cast<float>(boxes[i].projections[d].lo);
      all[i].max[d] = static_cast<float>(boxes[i].projections[d].hi - 1);
    }
  return all;
}

Input make_input(std::string_view batch, std::size_t n, std::uint64_t seed, LowEnds low_ends) {
  if (n >= std::size_t{1} << 23) throw std::length_error("the paper's integers are floats here only below 2^24");
  if (batch[0] != 'U' && batch[0] != 'W') {
    Input input{{}, batches::make(batch, n, seed)};
    input.boxes = ranks(Span<const Aabb>(input.closed));
    return input;
  }
  Input input;
  for (const Aabb64& box : batches::make64(batch, n, seed)) {
    Box& to = input.boxes.emplace_back();
    for (int d = 0; d < 3; ++d)
      to.projections[d] = {static_cast<std::int32_t>(box.min[d]), static_cast<std::int32_t>(box.max[d])};
  }
  if (low_ends == LowEnds::differ) spread_low_ends(input.boxes, seed);
  input.closed = closed(input.boxes);
  return input;
}

BipartiteInput make_bipartite(std::string_view batch, std::size_t n, std::uint64_t seed, LowEnds low_ends) {
  const Input all = make_input(batch, n, seed, low_ends);
  BipartiteInput two;
  deal(all.boxes, two.a.boxes, two.b.boxes);
  deal(all.closed, two.a.closed, two.b.closed);
  return two;
}

}  // namespace boxstream::papers
