// SPDX-License-Identifier: MIT
// Debug builds notice a Detector that is used twice at once.
#include <thread>

#include <gtest/gtest.h>

#include "oracle.hpp"

#ifndef NDEBUG
namespace boxstream::tests {
namespace {

void search_within_its_own_sink() {
  const Boxes<float> boxes(3, {{0, 0, 0}, {1, 1, 1}});
  Detector detector;
  Pairs out;
  detector.stream_pairs(boxes, [&](Span<const Pair>) { return detector.find_pairs(boxes, out).pairs > 0; });
}

void search_from_two_threads() {
  const Boxes<float> boxes(3, {{0, 0, 0}, {1, 1, 1}});
  Detector detector;
  detector.stream_pairs(boxes, [&](Span<const Pair>) {
    std::thread([&] {
      Pairs out;
      detector.find_pairs(boxes, out);
    }).join();
    return true;
  });
}

TEST(Misuse, OneDetectorTwiceAtOnceIsNoticed) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(search_within_its_own_sink(), "changed by two at once, or inside a callback");
  EXPECT_DEATH(search_from_two_threads(), "changed by two at once, or inside a callback");
}

}  // namespace
}  // namespace boxstream::tests
#endif
