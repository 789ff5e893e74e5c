// SPDX-License-Identifier: MIT
// Versions One to Four: what they find, and what memory they take, to the byte. A program of its own, because it counts
// allocations.
#include "papers/hybrid/versions.hpp"

#include <gtest/gtest.h>

#include "heap_watch.hpp"
#include "random.hpp"
#include "truth.hpp"

namespace boxstream::papers::tests {
namespace {

using boxstream::tests::Random;
namespace heap_watch = boxstream::tests::heap_watch;

std::vector<Box> scattered(std::size_t n, Random& random, int range, int longest) {
  std::vector<Box> boxes(n);
  for (Box& box : boxes)
    for (Interval& i : box.projections) {
      i.lo = random.integer(0, range);
      i.hi = i.lo + random.integer(1, longest);
    }
  return boxes;
}

struct Round {
  std::uint64_t seed;
  std::size_t n, m;
  int range, longest;
  HybridOptions options;
  std::string what;
  std::vector<Box> a, b;
};

/// Sparse and crowded, with few ties and with many, with cutoffs from none to more than there are boxes.
std::vector<Round> rounds() {
  std::vector<Round> all;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    Round r{seed,
            random.index(300),
            random.index(300),
            10 + random.integer(0, 1) * 1000,
            1 + random.integer(1, 100),
            {},
            "seed " + std::to_string(seed),
            {},
            {}};
    constexpr std::size_t cutoffs[] = {0, 3, 10, 50, 1000};
    r.options.cutoffs = Cutoffs(cutoffs[random.index(5)], cutoffs[random.index(5)]);
    r.options.level = {30, 2};
    r.options.seed = seed;
    r.a = scattered(r.n, random, r.range, r.longest);
    r.b = scattered(r.m, random, r.range, r.longest);
    all.push_back(r);
  }
  return all;
}

TEST(Versions, OneFindsPairsOfPlaces) {
  for (const Round& r : rounds())
    for (const auto sorting : {VersionOne::Sorting::structures, VersionOne::Sorting::pointers}) {
      VersionOne one{Span<const Box>(r.a)};
      const Pairs found = collect([&](auto&& sink) { one.find_pairs(sorting, r.options, sink); });
      ASSERT_TRUE(same_pairs(found, truth(one.boxes()), "One, " + r.what));
      // The boxes are those given, in order if they have been moved at all.
      ASSERT_EQ(truth(one.boxes()).size(), truth(r.a).size()) << r.what;
      if (sorting == VersionOne::Sorting::pointers) {
        ASSERT_TRUE(same_pairs(found, truth(r.a), "One, pointers, " + r.what));
      }
      // All arrays are in order again, so that the next search needs no sorting.
      ASSERT_EQ(collect([&](auto&& sink) { one.find_pairs_sorted(r.options, sink); }).size(), found.size()) << r.what;
    }
}

/// Sorting pointers leaves the boxes in their places, so that the pairs are the caller's, for every procedure.
TEST(Versions, OneRunsEveryProcedureOnSortedPointers) {
  for (const Round& r : rounds()) {
    VersionOne one{Span<const Box>(r.a)};
    one.sort(VersionOne::Sorting::pointers);
    for (const Procedure procedure : procedures())
      ASSERT_TRUE(same_pairs(collect([&](auto&& sink) { one.run_sorted(procedure, r.options, sink); }), truth(r.a),
                             std::string(name(procedure)) + ", " + r.what));
  }
}

TEST(Versions, TwoFindsPairs) {
  for (const Round& r : rounds()) {
    VersionTwo two{Span<const Box>(r.a)};
    ASSERT_TRUE(
        same_pairs(collect([&](auto&& sink) { two.find_pairs(r.options, sink); }), truth(r.a), "Two, " + r.what));
  }
}

TEST(Versions, ThreeFindsPairs) {
  for (const Round& r : rounds()) {
    VersionThree three{Span<const Box>(r.a), Span<const Box>(r.b)};
    ASSERT_TRUE(same_pairs(collect([&](auto&& sink) { three.find_pairs(r.options, sink); }), truth(r.a, r.b),
                           "Three, " + r.what));
  }
}

TEST(Versions, FourFindsPairsOfCubes) {
  for (const Round& r : rounds()) {
    const auto a = bounding_cubes(r.a), b = bounding_cubes(r.b);
    VersionFour four{Span<const Cube>(a), Span<const Cube>(b)};
    const Pairs expected = truth(as_boxes(a), as_boxes(b));
    ASSERT_TRUE(
        same_pairs(collect([&](auto&& sink) { four.find_pairs(r.options, sink); }), expected, "Four, " + r.what));
    // Bounding cubes have at least the pairs of what they bound.
    for (const Pair pair : truth(r.a, r.b)) ASSERT_TRUE(std::binary_search(expected.begin(), expected.end(), pair));
  }
}

/// A trace changes nothing, and adds up: every node but the two roots has a parent, leaves are scans.
TEST(Versions, ThreeTellsItsTree) {
  Random random(5);
  const auto a = scattered(2000, random, 1000, 99), b = scattered(2000, random, 1000, 99);
  HybridOptions options;
  options.cutoffs = Cutoffs(100);
  VersionThree plain{Span<const Box>(a), Span<const Box>(b)}, watched{Span<const Box>(a), Span<const Box>(b)};
  TreeTrace trace;
  const Pairs pairs = collect([&](auto&& sink) { watched.find_pairs(options, sink, trace); });
  EXPECT_EQ(pairs, collect([&](auto&& sink) { plain.find_pairs(options, sink); }));
  std::size_t roots = 0, spanning_nodes = 0, second_trees = 0;
  for (std::size_t at = 0; at < trace.entries().size(); ++at) {
    const TreeTrace::Entry& e = trace.entries()[at];
    EXPECT_GT(e.intervals, 0u);
    EXPECT_GT(e.points, 0u);
    EXPECT_EQ(e.node == Node::scanned, e.dimension == 0);
    if (e.node != Node::scanned) {
      EXPECT_EQ(e.node == Node::cut_off, std::min(e.intervals, e.points) < 100);
    }
    if (e.spanning > 0) spanning_nodes += 1;
    if (e.parent == TreeTrace::none) {
      roots += 1;
      EXPECT_EQ(e.dimension, 2);
      continue;
    }
    ASSERT_LT(e.parent, at);
    const TreeTrace::Entry& parent = trace.entries()[e.parent];
    EXPECT_EQ(parent.node, Node::streamed);
    EXPECT_TRUE(e.dimension == parent.dimension || e.dimension == parent.dimension - 1);
    if (e.dimension < parent.dimension) {
      second_trees += 1;
      EXPECT_TRUE(e.intervals == parent.spanning || e.points == parent.spanning);
    }
  }
  EXPECT_EQ(roots, 2u);
  EXPECT_GT(spanning_nodes, 0u);
  EXPECT_EQ(second_trees, 2 * spanning_nodes);
}

/// Table 3, by what a version allocates for `boxes` and for twice as many, and what a search adds: nothing.
/// The allocator's rounding is the same for both, since the numbers of boxes are multiples of 16.
template <class Make>
void expect_bytes(std::size_t bytes_per_box, const Make& make) {
  std::int64_t bytes[2];
  for (const std::size_t times : {1u, 2u}) {
    const std::int64_t before = heap_watch::live_bytes();
    auto version = make(512 * times);
    bytes[times - 1] = heap_watch::live_bytes() - before;
    const std::uint64_t allocations = heap_watch::allocations();
    std::uint64_t pairs = 0;
    HybridOptions options;
    options.cutoffs = Cutoffs(20);
    const auto count = [&](std::uint32_t, std::uint32_t) { ++pairs; };
    if constexpr (requires { version.find_pairs(options, count); })
      version.find_pairs(options, count);
    else
      version.find_pairs(VersionOne::Sorting::structures, options, count);
    EXPECT_EQ(heap_watch::allocations(), allocations);
    EXPECT_GT(pairs, 0u);
  }
  EXPECT_EQ(bytes[1] - bytes[0], static_cast<std::int64_t>(bytes_per_box * 512));
  EXPECT_LT(bytes[0], static_cast<std::int64_t>(bytes_per_box * 512 + 100));
}

TEST(Versions, TakeTheBytesOfTable3) {
  Random random(6);
  const auto boxes = scattered(1024, random, 300, 60);
  const auto cubes = bounding_cubes(boxes);
  const Span<const Box> b(boxes);
  const Span<const Cube> c(cubes);
  expect_bytes(36, [&](std::size_t n) { return VersionOne{b.subspan(0, n)}; });
  expect_bytes(56, [&](std::size_t n) { return VersionTwo{b.subspan(0, n)}; });
  expect_bytes(28, [&](std::size_t n) { return VersionThree{b.subspan(0, n / 4), b.subspan(n / 4, n - n / 4)}; });
  expect_bytes(20, [&](std::size_t n) { return VersionFour{c.subspan(0, n / 4), c.subspan(n / 4, n - n / 4)}; });
}

}  // namespace
}  // namespace boxstream::papers::tests
