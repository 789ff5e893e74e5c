// SPDX-License-Identifier: MIT
// What a search out of core takes from the heap: no more than it was given. Any of it may be refused.
#include <cstdint>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>

#include "core/box_sets.hpp"
#include "core/executors.hpp"
#include "heap_watch.hpp"
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
  const std::vector<std::uint64_t> all{64 * KiB, 65 * KiB,  88 * KiB, 133 * KiB, 200 * KiB,
                                       555 * KiB, 3 * MiB, 17 * MiB}, few{64 * KiB, 555 * KiB};
  for (const std::uint64_t memory : tests::sanitized ? few : all)
    for (const auto& set : tests::box_sets_to_repeat<TypeParam>()) {
      const std::size_t fit = Budget::of<TypeParam>(memory, false).boxes;
      for (const std::size_t n : {fit, fit + 1, 5 * fit}) {
        if (n > 40000 && n != fit) continue;
        VectorReader<TypeParam> reader(set.make(std::min(n, set.largest), memory));
        EXPECT_LE(taken<TypeParam>(reader, {memory}), memory) << set.name << " " << n << " in " << memory / KiB;
      }
    }
}

}  // namespace
}  // namespace boxstream::out_of_core_test
