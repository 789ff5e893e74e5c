// SPDX-License-Identifier: MIT
// What a search allocates: nothing when it is warm, O(n) while it streams, and what happens when it may not.
#include <time.h>

#include <new>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <boxstream/near.hpp>

#include "box_sets.hpp"
#include "executors.hpp"
#include "heap_watch.hpp"
#include "many_sets.hpp"
#include "oracle.hpp"
#include "sanitized.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class Memory : public testing::Test {
 protected:
  Memory() : inline_(4) {}
  std::vector<Executor*> executors() { return {nullptr, &inline_}; }
  /// By either method, with each executor.
  std::vector<DetectorOptions> options() {
    std::vector<DetectorOptions> all;
    for (const Method method : {Method::planned, Method::hybrid})
      for (Executor* executor : executors()) all.push_back({executor, method});
    return all;
  }

 private:
  InlineExecutor inline_;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Memory, Scalars);

/// A warm-up; then the same again, and other data of the same size and distribution.
TYPED_TEST(Memory, WarmSearchAllocatesNothing) {
  for (const DetectorOptions& options : this->options())
    for (const auto& set : box_sets_to_repeat<TypeParam>()) {
      const std::size_t n = std::min<std::size_t>(20000, set.largest), m = n / 4;
      SCOPED_TRACE(set.name);
      const auto a = set.make(n, 1), b = set.make(m, 2), other_a = set.make(n, 3), other_b = set.make(m, 4);
      Detector detector(options);
      Pairs within, between;
      std::uint64_t streamed = 0;
      const auto sink = [&](Span<const Pair> pairs) {
        streamed += pairs.size();
        return true;
      };
      detector.find_pairs(a, within);
      detector.find_pairs(a, b, between);
      detector.stream_pairs(a, sink);
      detector.stream_pairs(a, b, sink);
      within.reserve(2 * within.size() + 1000);
      between.reserve(2 * between.size() + 1000);

      const auto allocations_of = [](auto search) {
        const std::uint64_t before = heap_watch::allocations();
        search();
        return heap_watch::allocations() - before;
      };
      EXPECT_EQ(allocations_of([&] { detector.find_pairs(a, within); }), 0u);
      EXPECT_EQ(allocations_of([&] { detector.find_pairs(a, b, between); }), 0u);
      EXPECT_EQ(allocations_of([&] { detector.stream_pairs(a, sink); }), 0u);
      EXPECT_EQ(allocations_of([&] { detector.stream_pairs(a, b, sink); }), 0u);
      EXPECT_EQ(streamed, 2 * (within.size() + between.size()));
      if (options.executor == nullptr) {
        EXPECT_EQ(allocations_of([&] { detector.find_pairs(other_a, within); }), 0u) << "other data";
        EXPECT_EQ(allocations_of([&] { detector.find_pairs(other_a, other_b, between); }), 0u) << "other data";
      }
    }
}

/// The same where the search is done by classes of filters.
TYPED_TEST(Memory, WarmFilteredSearchAllocatesNothing) {
  for (Executor* executor : this->executors()) {
    const auto boxes = box_set<TypeParam>("dense").make(20000, 1);
    std::vector<Filter> groups(boxes.size()), mostly_static(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      groups[i] = {1u << i % 10, 1u << i % 10};
      mostly_static[i] = i % 20 == 0 ? Filter{2, 3} : Filter{1, 2};
    }
    for (const auto& filters : {groups, mostly_static}) {
      Detector detector(DetectorOptions{executor});
      Pairs pairs;
      detector.find_pairs(boxes, pairs, filters);
      const std::uint64_t before = heap_watch::allocations();
      detector.find_pairs(boxes, pairs, filters);
      EXPECT_EQ(heap_watch::allocations() - before, 0u);
    }
  }
}

/// The same of many sets: some too large for one thread, some for the smallest way of searching, some empty.
TYPED_TEST(Memory, WarmSearchOfManySetsAllocatesNothing) {
  std::vector<std::size_t> sizes = uneven_sizes(1000, 1);
  sizes.insert(sizes.begin() + 300, 20000);
  const auto sets = make_many<TypeParam>(sizes, 1);
  for (Executor* executor : this->executors()) {
    Detector detector(DetectorOptions{executor});
    PairsOfSets pairs;
    const auto search = [&] {
      detector.find_pairs(sets.boxes, sets.offsets, pairs);
      detector.find_pairs(sets.boxes, sets.offsets, sets.boxes, sets.offsets, pairs, sets.filters);
      detector.stream_pairs(sets.boxes, sets.offsets, [](Span<const Pair>) { return true; });
    };
    search();
    const std::uint64_t before = heap_watch::allocations();
    search();
    EXPECT_EQ(heap_watch::allocations() - before, 0u);
  }
}

/// Twenty thousand float boxes in one place (half as many doubles): 2 * 10^8 pairs through memory for a few numbers per
/// box.
TYPED_TEST(Memory, StreamingQuadraticOutputIsLinearInMemory) {
  const std::size_t n = sanitized ? 3000 : sizeof(TypeParam) == 8 ? 10000 : 20000;
  for (Executor* executor : this->executors()) {
    Boxes<TypeParam> boxes(n, {{0, 0, 0}, {1, 1, 1}});
    boxes.push_back({{5, 5, 5}, {6, 6, 6}});
    Detector detector(DetectorOptions{executor});
    std::uint64_t streamed = 0, sum = 0;
    heap_watch::reset_peak();
    const std::int64_t before = heap_watch::live_bytes();
    const Stats stats = detector.stream_pairs(boxes, [&](Span<const Pair> pairs) {
      streamed += pairs.size();
      for (const Pair pair : pairs) sum += pair.a;
      return true;
    });
    EXPECT_EQ(stats.pairs, n * (n - 1) / 2);
    EXPECT_EQ(streamed, stats.pairs);
    std::uint64_t expected_sum = 0;
    for (std::uint64_t i = 0; i < n; ++i) expected_sum += i * (n - 1 - i);
    EXPECT_EQ(sum, expected_sum);
    EXPECT_LE(heap_watch::peak_bytes() - before, static_cast<std::int64_t>(512 * n + 65536));
  }
}

/// Groups in one place, far from each other: the tree is split, and each task of an executor has more pairs than boxes.
TYPED_TEST(Memory, StreamingGroupsIsLinearInMemory) {
  const std::size_t groups = 8, each = sanitized ? 600 : 2500, n = groups * each;
  Boxes<TypeParam> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<TypeParam>(100 * (i % groups));
    boxes.push_back({{at, at, at}, {at + 1, at + 1, at + 1}});
  }
  const std::uint64_t expected = groups * each * (each - 1) / 2;
  for (Executor* executor : this->executors()) {
    Detector detector(DetectorOptions{executor});
    std::uint64_t streamed = 0;
    heap_watch::reset_peak();
    const std::int64_t before = heap_watch::live_bytes();
    detector.stream_pairs(boxes, [&](Span<const Pair> pairs) {
      streamed += pairs.size();
      return true;
    });
    EXPECT_EQ(streamed, expected);
    // Each task of an executor may hold back 2^16 + n / 16 pairs of 8 bytes, in a vector that doubles.
    const std::size_t held_back = executor == nullptr ? 0 : 64 * 2 * 8 * (65536 + n / 16);
    EXPECT_LE(heap_watch::peak_bytes() - before, static_cast<std::int64_t>(512 * n + 65536 + held_back));
  }
}

/// The last number of identical boxes whose pairs 32 bits, signed, can count, and the next: through memory for a few
/// numbers per box, in less than a minute of this thread's time.
TEST(MemoryCounts, PairCountsPass2To31) {
  if (sanitized) GTEST_SKIP() << "takes minutes under a sanitizer";
  for (const std::uint64_t n : {std::uint64_t{65536}, std::uint64_t{65537}}) {
    const Boxes<float> boxes(n, {{0, 0, 0}, {1, 1, 1}});
    std::uint64_t streamed = 0;
    heap_watch::reset_peak();
    const std::int64_t before = heap_watch::live_bytes();
    timespec begin{}, end{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begin);
    const Stats stats = Detector().stream_pairs(boxes, [&](Span<const Pair> pairs) {
      streamed += pairs.size();
      return true;
    });
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
    const std::uint64_t expected = n == 65536 ? 2147450880u : 2147516416u;
    EXPECT_EQ(stats.pairs, expected);
    EXPECT_EQ(streamed, expected);
    EXPECT_LE(heap_watch::peak_bytes() - before, static_cast<std::int64_t>(512 * n + 65536));
    EXPECT_LT(end.tv_sec - begin.tv_sec, 60);
  }
}

/// What a Detector says of its memory is what it has taken from the heap.
TYPED_TEST(Memory, ScratchBytesAreThoseOfTheHeap) {
  for (Executor* executor : this->executors())
    for (const std::size_t n : {100, 3000, 40000}) {
      const auto boxes = box_set<TypeParam>("rods_mixed").make(n, 1);
      Pairs pairs(20 * n);
      const std::int64_t before = heap_watch::live_bytes();
      Detector detector(DetectorOptions{executor});
      detector.find_pairs(boxes, pairs);
      const auto taken = static_cast<double>(heap_watch::live_bytes() - before);
      const auto said = static_cast<double>(detector.scratch_bytes());
      EXPECT_LE(said, taken);
      EXPECT_LE(taken, 1.02 * said + 4096) << n << " boxes";
    }
}

/// The pairs of which rows of neighbours are made are kept, too.
TYPED_TEST(Memory, ScratchBytesCountPairsOfNeighbours) {
  const auto boxes = box_set<TypeParam>("dense").make(20000, 1);
  Detector detector;
  Pairs pairs;
  detector.find_pairs(boxes, pairs);
  const std::size_t before = detector.scratch_bytes();
  Neighbours neighbours;
  const Stats stats = detector.find_neighbours(boxes, neighbours);
  EXPECT_GT(stats.pairs, 20000u);
  EXPECT_GE(detector.scratch_bytes(), before + stats.pairs * sizeof(Pair));
}

enum class Search { one_set, two_sets, balls };

/// Lets each allocation fail; of every second one the search is made again at once, and another allocation fails. Each
/// time: std::bad_alloc, an empty vector, a Detector that works, and no block lost.
template <class S>
void fail_each_allocation(const std::string& scene, std::size_t n, const DetectorOptions& options, bool warm,
                          Search what) {
  SCOPED_TRACE(scene + " of " + std::to_string(n) + ", search " + std::to_string(int(what)) + (warm ? ", warm" : ""));
  const auto a = box_set<S>(scene).make(n, 1), b = box_set<S>(scene).make(n / 3, 2),
             small = box_set<S>(scene).make(70, 3);
  std::vector<BasicBall<S>> balls;
  for (const auto& box : a) balls.push_back({{box.min[0], box.min[1], box.min[2]}, (box.max[0] - box.min[0]) / 2});
  const auto search = [&](Detector& detector, Pairs& out) {
    if (what == Search::one_set) detector.find_pairs(a, out);
    if (what == Search::two_sets) detector.find_pairs(a, b, out);
    if (what == Search::balls) find_near_pairs(detector, Span<const BasicBall<S>>(balls), S(0), out);
  };
  Pairs truth, small_truth;
  {
    Detector detector(options);
    search(detector, truth);
    detector.find_pairs(small, small_truth);
  }
  const std::int64_t live_before = heap_watch::live_allocations();
  bool failed = true;
  for (std::int64_t first = 0; failed; ++first) {
    ASSERT_LT(first, 5000) << "never finishes";
    Pairs out;
    {
      Detector detector(options);
      if (warm) detector.find_pairs(small, out);
      const bool twice = first % 2 == 1;
      heap_watch::fail_at(first, twice ? first * 7 % 5 : heap_watch::never);
      for (int attempt = 0; attempt < (twice ? 2 : 1); ++attempt) try {
          search(detector, out);
          // An allocation that is only for later calls may fail without harm; then the result must be whole.
          ASSERT_EQ(out, truth) << "after allocation " << first;
        } catch (const std::bad_alloc&) {
          ASSERT_TRUE(out.empty()) << "after allocation " << first;
        }
      failed = heap_watch::stop_failing();
      detector.find_pairs(small, out);
      ASSERT_EQ(out, small_truth) << "after allocation " << first;
      search(detector, out);
      ASSERT_EQ(out, truth) << "after allocation " << first;
    }
    Pairs().swap(out);
    ASSERT_EQ(heap_watch::live_allocations(), live_before) << "after allocation " << first;
  }
}

TYPED_TEST(Memory, EachAllocationMayFail) {
  for (const DetectorOptions& options : this->options())
    for (const auto& [scene, n] : {std::pair("dense", 300), std::pair("rods_mixed", 3000), std::pair("sparse", 20000),
                                   std::pair("identical", 300)})
      for (const bool warm : {false, true})
        for (const Search what : {Search::one_set, Search::two_sets, Search::balls})
          if (!sanitized || warm == (what == Search::one_set))
            fail_each_allocation<TypeParam>(scene, static_cast<std::size_t>(n), options, warm, what);
}

TYPED_TEST(Memory, EachAllocationOfManySetsMayFail) {
  const auto sets = make_many<TypeParam>(uneven_sizes(sanitized ? 300 : 500, 5), 5);
  PairsOfSets truth;
  Detector().find_pairs(sets.boxes, sets.offsets, truth);
  for (Executor* executor : this->executors()) {
    const std::int64_t live_before = heap_watch::live_allocations();
    bool failed = true;
    for (std::int64_t allowed = 0; failed; ++allowed) {
      ASSERT_LT(allowed, 1000) << "never finishes";
      {
        Detector detector(DetectorOptions{executor});
        PairsOfSets out;
        heap_watch::fail_after(allowed);
        bool threw = false;
        try {
          detector.find_pairs(sets.boxes, sets.offsets, out);
        } catch (const std::bad_alloc&) {
          threw = true;
        }
        failed = heap_watch::stop_failing();
        // One that only keeps memory for the next search may fail.
        if (threw) {
          EXPECT_TRUE(out.pairs.empty() && out.offsets.empty());
        } else {
          EXPECT_EQ(out.offsets, truth.offsets);
        }
        detector.find_pairs(sets.boxes, sets.offsets, out);
        EXPECT_TRUE(out.pairs == truth.pairs && out.offsets == truth.offsets) << "after allocation " << allowed;
      }
      ASSERT_EQ(heap_watch::live_allocations(), live_before) << "after allocation " << allowed;
    }
  }
}

TEST(MemoryConstruction, EachAllocationMayFail) {
  const std::int64_t live_before = heap_watch::live_allocations();
  bool failed = true;
  for (std::int64_t allowed = 0; failed; ++allowed) {
    ASSERT_LT(allowed, 100);
    heap_watch::fail_after(allowed);
    bool threw = false;
    try {
      Detector detector;
    } catch (const std::bad_alloc&) {
      threw = true;
    }
    failed = heap_watch::stop_failing();
    EXPECT_EQ(threw, failed);
    EXPECT_EQ(heap_watch::live_allocations(), live_before);
  }
}

TYPED_TEST(Memory, ScratchIsKeptAndLinear) {
  Detector detector;
  EXPECT_EQ(detector.scratch_bytes(), 0u);
  Pairs pairs;
  for (const std::size_t n : {1000, 10000, 40000}) {
    detector.find_pairs(box_set<TypeParam>("sparse").make(n, 1), pairs);
    const std::size_t scratch = detector.scratch_bytes();
    EXPECT_GE(scratch, n);
    EXPECT_LE(scratch, 512 * n + 65536);
    detector.find_pairs(box_set<TypeParam>("sparse").make(10, 1), pairs);
    EXPECT_EQ(detector.scratch_bytes(), scratch) << "kept for the next large search";
  }
}

/// Bytes a box, as docs/scale.md states them. Nearly always all of them are taken at once: the second search finds warm
/// what the first has touched.
TYPED_TEST(Memory, ScratchOfABox) {
  int sets = 0, in_parts = 0;
  for (const auto& set : box_sets_to_repeat<TypeParam>())
    for (const std::size_t n : {1000, 20000, 200000}) {
      if (n > set.largest) continue;
      SCOPED_TRACE(set.name + " " + std::to_string(n));
      const auto boxes = set.make(n, 1);
      Detector detector;
      const auto sink = [](Span<const Pair>) { return true; };
      const std::uint64_t before = heap_watch::allocations();
      detector.stream_pairs(boxes, sink);
      ++sets;
      in_parts += heap_watch::allocations() - before > 2;  // a block and the list of blocks
      const double few = sizeof(TypeParam) == 4 ? 245 : 310;
      EXPECT_LT(static_cast<double>(detector.scratch_bytes()), (n < 65536 ? few : 180) * static_cast<double>(n));
    }
  EXPECT_LT(in_parts, 5 + sets / 10);
}

TYPED_TEST(Memory, ScratchGoesBack) {
  for (Executor* executor : this->executors()) {
    const auto boxes = box_set<TypeParam>("dense").make(40000, 1);
    Pairs pairs, again;
    Neighbours neighbours;
    Detector detector(DetectorOptions{executor});
    PairRules rules;
    rules.tolerance = 0.25;  // takes a copy
    detector.find_pairs(boxes, pairs, rules);
    detector.find_neighbours(boxes, neighbours, rules);
    again.reserve(pairs.size());
    const std::int64_t before = heap_watch::live_bytes();
    const std::size_t scratch = detector.scratch_bytes();
    detector.shrink_to_fit();
    EXPECT_EQ(detector.scratch_bytes(), 0u);
    EXPECT_GE(before - heap_watch::live_bytes(), static_cast<std::int64_t>(scratch));
    detector.find_pairs(boxes, again, rules);
    EXPECT_EQ(again, pairs);
  }
}

TYPED_TEST(Memory, ScratchIsBoundedWhateverAnExecutorOffers) {
  for (const std::size_t n : {20000, 200000}) {
    const auto boxes = box_set<TypeParam>("sparse").make(n, 1);
    const auto scratch = [&](unsigned concurrency) {
      InlineExecutor executor(concurrency);
      Detector detector({&executor});
      Pairs pairs;
      detector.find_pairs(boxes, pairs);
      return detector.scratch_bytes();
    };
    EXPECT_LE(scratch(100000), 3 * scratch(1)) << n;
    EXPECT_EQ(scratch(100000), scratch(10000)) << n;
  }
}

}  // namespace
}  // namespace boxstream::tests
