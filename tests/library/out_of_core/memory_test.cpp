// SPDX-License-Identifier: MIT
// What a search out of core takes from the heap: no more than it was given. Any of it may be refused.
#include <cstdint>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>

#include "core/box_sets.hpp"
#include "core/executors.hpp"
#include "file_calls.hpp"
#include "heap_watch.hpp"
#include "open_files.hpp"
#include "out_of_core/budget.hpp"
#include "sanitized.hpp"
#include "scratch_directory.hpp"
#include "vector_reader.hpp"

namespace boxstream::out_of_core_test {
namespace {

namespace heap_watch = tests::heap_watch;
using detail::Budget;

constexpr std::uint64_t KiB = 1 << 10, MiB = 1 << 20;

template <class S>
class OutOfCoreMemory : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(OutOfCoreMemory, Scalars);

/// The most that was taken at once. Pairs beyond some millions are not waited for.
template <class S>
std::uint64_t taken(BasicBoxReader<S>& reader, const OutOfCoreOptions& options, OutOfCoreStats* stats = nullptr) {
  std::uint64_t pairs = 0;
  const auto sink = [&](Span<const WidePair> batch) { return (pairs += batch.size()) < 5000000; };
  heap_watch::reset_peak();
  const std::int64_t before = heap_watch::live_bytes();
  const OutOfCoreStats found = stream_pairs(reader, sink, options);
  if (stats != nullptr) *stats = found;
  EXPECT_EQ(heap_watch::live_bytes(), before);
  return static_cast<std::uint64_t>(heap_watch::peak_bytes() - before);
}

/// As many boxes as are searched at once, the worst number, and several times as many, which go through the file.
TYPED_TEST(OutOfCoreMemory, IsWhatWasGiven) {
  const std::vector<std::uint64_t> all{64 * KiB,  65 * KiB,  88 * KiB, 133 * KiB,
                                       200 * KiB, 555 * KiB, 3 * MiB,  17 * MiB},
      few{64 * KiB, 555 * KiB};
  for (const std::uint64_t memory : tests::sanitized ? few : all)
    for (const auto& set : tests::box_sets_to_repeat<TypeParam>()) {
      const std::size_t fit = Budget::of<TypeParam>(memory).boxes;
      for (const std::size_t n : {fit, fit + 1, 5 * fit}) {
        if (n > 40000 && n != fit) continue;
        VectorReader<TypeParam> reader(set.make(std::min(n, set.largest), memory));
        EXPECT_LE(taken<TypeParam>(reader, {memory}), memory) << set.name << " " << n << " in " << memory / KiB;
      }
    }
}

/// The file's blocks are known by 8 bytes each, which no option bounds.
TYPED_TEST(OutOfCoreMemory, IsWhatWasGivenHoweverManyBoxesThereAre) {
  VectorReader<TypeParam> reader(tests::box_set<TypeParam>("sparse").make(tests::sanitized ? 30000 : 150000, 1));
  OutOfCoreStats stats;
  const std::uint64_t most = taken<TypeParam>(reader, {64 * KiB}, &stats);
  EXPECT_GT(stats.file_bytes, 16 * 64 * KiB);
  EXPECT_LE(most, 64 * KiB + stats.file_bytes / 512);
}

/// Threads take more, for pairs that wait for their turn: a search is shared where that is a part of the memory.
TYPED_TEST(OutOfCoreMemory, IsWhatWasGivenWithAnExecutor) {
  Boxes<TypeParam> boxes = tests::box_set<TypeParam>("dense").make(tests::sanitized ? 30000 : 200000, 1);
  for (const std::size_t pile : {0, 7000, 14000})
    for (std::size_t i = 0; i < 2000; ++i) boxes[pile + i] = boxes[pile];
  VectorReader<TypeParam> reader(boxes);
  for (const std::uint64_t memory : {MiB, 5 * MiB, 64 * MiB, 70 * MiB}) {
    tests::InlineExecutor executor(8, 0);
    EXPECT_LE(taken<TypeParam>(reader, {memory, {}, &executor}), memory) << memory / MiB;
    EXPECT_EQ(executor.calls() != 0, memory >= 64 * MiB);
  }
}

/// What a search that may fail leaves behind: nothing.
class LeavesNothing {
 public:
  ~LeavesNothing() {
    EXPECT_EQ(heap_watch::live_allocations(), live_before_);
    EXPECT_EQ(open_files().size(), open_before_);
    EXPECT_EQ(directory_.count(), 0u);
  }
  std::string directory() const { return directory_.file(""); }

 private:
  const tool_test::ScratchDirectory directory_;
  const std::size_t open_before_ = open_files().size();
  const std::int64_t live_before_ = heap_watch::live_allocations();
};

/// The error codes of a full disk, or none; `bad_alloc` if memory fails first.
template <class S>
std::errc outcome(VectorReader<S>& reader, const OutOfCoreOptions& options, std::uint64_t& pairs) {
  pairs = 0;
  const auto count = [&](Span<const WidePair> batch) {
    pairs += batch.size();
    return true;
  };
  const heap_watch::Failures come(true);
  try {
    stream_pairs(reader, count, options);
  } catch (const std::bad_alloc&) {
    return std::errc::not_enough_memory;
  } catch (const std::system_error& error) {
    return std::errc{error.code().value()};
  }
  return {};
}

/// Lets each allocation fail, and then each of those that are still made after it, while the search is given up.
template <class S>
void fail_each_allocation(VectorReader<S>& reader, std::uint64_t room, std::errc without_failures) {
  std::uint64_t pairs = 0, truth = 0;
  if (without_failures == std::errc{}) outcome(reader, {64 * KiB}, truth);
  bool failed = true;
  for (std::int64_t first = 0; failed; first += tests::sanitized ? 9 : 1) {
    const LeavesNothing left;
    const OutOfCoreOptions options{64 * KiB, left.directory()};
    bool reached = true;
    for (std::int64_t then = heap_watch::never; reached; ++then) {
      file_calls::room = room;
      heap_watch::fail_at(first, then);
      const std::errc code = outcome(reader, options, pairs);
      reached = then == heap_watch::never || heap_watch::tried() > first + 1 + then;
      failed = heap_watch::stop_failing();
      ASSERT_EQ(code, failed ? std::errc::not_enough_memory : without_failures) << first << ", " << then;
      if (!failed) {
        ASSERT_EQ(pairs, truth);
      }
    }
  }
}

TYPED_TEST(OutOfCoreMemory, EachAllocationMayFail) {
  VectorReader<TypeParam> reader(tests::box_set<TypeParam>("dense").make(700, 2));
  for (const bool named : {false, true}) {
    const file_calls::Refusals refusals;
    file_calls::refuse_nameless = named;
    fail_each_allocation<TypeParam>(reader, file_calls::unlimited, {});
    fail_each_allocation<TypeParam>(reader, 30000, std::errc::no_space_on_device);
  }
}

}  // namespace
}  // namespace boxstream::out_of_core_test
