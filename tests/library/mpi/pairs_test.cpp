// SPDX-License-Identifier: MIT
// The pairs of all ranks together are those of one machine, each once, however boxes are shared out.
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/box_sets.hpp"
#include "core/same_pairs.hpp"
#include "inputs/batches.hpp"
#include "shares.hpp"

namespace boxstream::mpi_test {
namespace {

template <class S>
struct Found {
  std::vector<WidePair> pairs;
  mpi::Stats stats;
};

template <class S>
Found<S> find(const Boxes<S>& all, Way way, std::size_t boxes_in_round = INT_MAX) {
  const Share<S> share(all, way);
  Found<S> found;
  mpi::Options options;
  options.boxes_in_round = boxes_in_round;
  found.stats = mpi::find_pairs(MPI_COMM_WORLD, share.boxes, share.ids, found.pairs, options);
  EXPECT_EQ(found.stats.boxes, share.boxes.size());
  EXPECT_EQ(found.stats.pairs, found.pairs.size());
  return found;
}

std::uint64_t sum(std::uint64_t own) {
  const auto all = from_all(own);
  return std::accumulate(all.begin(), all.end(), std::uint64_t{0});
}

/// `truth` is asked for on one rank.
template <class S>
void expect_truth(const Boxes<S>& boxes, Pairs (*truth)(const Boxes<S>&), Way way, const std::string& scene,
                  std::uint64_t seed) {
  const Found<S> found = find(boxes, way);
  const Pairs pairs = united(found.pairs);
  if (rank() == 0) tests::expect_same_pairs<S>(pairs, truth(boxes), boxes, scene, seed);
  EXPECT_EQ(sum(found.stats.invalid), tests::count_invalid(boxes)) << scene;
}

template <class S>
Pairs brute_force(const Boxes<S>& boxes) {
  return tests::brute_force(boxes);
}

template <class S>
Pairs one_machine(const Boxes<S>& boxes) {
  Pairs pairs = boxstream::find_pairs(Span<const BasicAabb<S>>(boxes));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template <class S>
class Batch : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Batch, Scalars);

TYPED_TEST(Batch, EqualsTruthForSetsOfEveryKind) {
  std::size_t turn = 0;
  for (const auto& set : tests::box_sets_to_repeat<TypeParam>()) {
    const auto boxes = set.make(std::min<std::size_t>(600, set.largest), 1);
    expect_truth(boxes, brute_force, ways[turn++ % std::size(ways)], set.name, 1);
  }
  EXPECT_GE(turn, 5u);
}

/// So many that not all of them are in the sample.
TYPED_TEST(Batch, EqualsTruthForBatches) {
  std::size_t turn = 0;
  for (const char* name : {"U", "S", "C", "heap", "lattice", "rods", "lattice_j"}) {
    const auto in_double = batches::make64(name, 20000, 2);
    Boxes<TypeParam> boxes;
    for (const Aabb64& box : in_double) {
      boxes.emplace_back();
      for (int d = 0; d < 3; ++d) {
        boxes.back().min[d] = static_cast<TypeParam>(box.min[d]);
        boxes.back().max[d] = static_cast<TypeParam>(box.max[d]);
      }
    }
    expect_truth(boxes, one_machine, ways[turn++ % std::size(ways)], name, 2);
  }
}

TYPED_TEST(Batch, NoBoxesOneBoxAndTwo) {
  for (const std::size_t n : {0, 1, 2})
    for (const Way way : ways) {
      const Boxes<TypeParam> boxes(n, {{0, 0, 0}, {1, 1, 1}});
      expect_truth(boxes, brute_force, way, "equal boxes", n);
    }
}

/// A world of infinite boxes, half-spaces and bars among small ones.
TYPED_TEST(Batch, UnboundedBoxesMeetAllOthers) {
  constexpr TypeParam inf = std::numeric_limits<TypeParam>::infinity();
  auto boxes = tests::box_set<TypeParam>("sparse").make(3000, 4);
  for (std::size_t i = 0; i < 5; ++i) {
    boxes[i * 500] = {{-inf, -inf, -inf}, {inf, inf, inf}};
    boxes[i * 500 + 1].min[i % 3] = -inf;
    boxes[i * 500 + 2].max[i % 3] = inf;
    boxes[i * 500 + 3].min[i % 3] = -inf;
    boxes[i * 500 + 3].max[i % 3] = inf;
  }
  const Found<TypeParam> found = find(boxes, Way::round_robin);
  const Pairs pairs = united(found.pairs);
  if (rank() == 0) tests::expect_same_pairs<TypeParam>(pairs, brute_force(boxes), boxes, "unbounded", 4);
  EXPECT_EQ(sum(found.stats.received >= 5 ? 1 : 0), static_cast<std::uint64_t>(size()));
}

TYPED_TEST(Batch, WhoGivesABoxDoesNotDecideWhoHasItsPairs) {
  const auto boxes = batches::make64("C", 20000, 3);
  std::vector<WidePair> first;
  for (const Way way : ways) {
    auto pairs = find(boxes, way).pairs;
    std::sort(pairs.begin(), pairs.end());
    if (way == ways[0]) first = pairs;
    EXPECT_TRUE(pairs == first) << "way " << static_cast<int>(way);
  }
}

TYPED_TEST(Batch, OrderIsAFunctionOfTheInput) {
  const auto boxes = tests::box_set<TypeParam>("dense").make(3000, 5);
  EXPECT_TRUE(find(boxes, Way::sorted).pairs == find(boxes, Way::sorted).pairs);
}

TYPED_TEST(Batch, RoundsChangeNothing) {
  const auto boxes = tests::box_set<TypeParam>("dense").make(1000, 6);
  auto whole = find(boxes, Way::every_other_empty).pairs;
  std::sort(whole.begin(), whole.end());
  for (const std::size_t in_round : {1, 7, 300}) {
    if (in_round == 1 && size() > 3) continue;  // a thousand rounds
    auto pairs = find(boxes, Way::every_other_empty, in_round).pairs;
    std::sort(pairs.begin(), pairs.end());
    EXPECT_TRUE(pairs == whole) << in_round;
  }
}

}  // namespace
}  // namespace boxstream::mpi_test
