// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <boxstream/detail/place_table.hpp>

#include <cstdint>
#include <random>
#include <vector>

namespace boxstream {
namespace {

using detail::PlaceTable;

/// What came and went, in any order: every address leads to its place, and no other one does.
TEST(PlaceTable, FindsWhatIsThere) {
  for (const std::uintptr_t stride : {8, 16, 64, 4096, 1 << 20}) {
    std::mt19937 random(static_cast<unsigned>(stride));
    PlaceTable table;
    std::vector<void*> at;
    std::size_t count = 0;
    for (int step = 0; step < 3000; ++step) {
      const std::uint32_t place = random() % (at.size() + 1);
      if (place < at.size() && at[place] != nullptr && random() % 2 == 0) {
        table.erase(place, at);
        at[place] = nullptr;
        --count;
      } else {
        table.reserve(count + 1, at);
        at.push_back(reinterpret_cast<void*>(stride * (at.size() + 1)));
        table.insert(static_cast<std::uint32_t>(at.size() - 1), at);
        ++count;
      }
      if (step % 50 != 0) continue;
      for (std::uint32_t i = 0; i < at.size(); ++i)
        ASSERT_EQ(table.find(reinterpret_cast<void*>(stride * (i + 1)), at), at[i] != nullptr ? i : PlaceTable::none);
      ASSERT_EQ(table.find(&random, at), PlaceTable::none);
    }
    table.renew(at);
    for (std::uint32_t i = 0; i < at.size(); ++i)
      if (at[i] != nullptr) {
        ASSERT_EQ(table.find(at[i], at), i);
      }
  }
}

/// Of each gap that closes, what follows moves down by one.
TEST(PlaceTable, FollowsWhatMoves) {
  std::mt19937 random(3);
  PlaceTable table;
  std::vector<void*> at;
  std::uintptr_t next = 0;
  table.reserve(40, at);
  for (int step = 0; step < 2000; ++step) {
    if (at.size() < 40 && random() % 2 == 0) {
      at.push_back(reinterpret_cast<void*>(16 * ++next));
      table.insert(static_cast<std::uint32_t>(at.size() - 1), at);
    } else if (!at.empty()) {
      const auto place = static_cast<std::uint32_t>(random() % at.size());
      table.erase(place, at);
      for (std::uint32_t from = place + 1; from < at.size(); ++from) {
        table.rename(from, from - 1, at);
        at[from - 1] = at[from];
      }
      at.pop_back();
    }
    for (std::uint32_t i = 0; i < at.size(); ++i) ASSERT_EQ(table.find(at[i], at), i);
    ASSERT_EQ(table.find(&random, at), PlaceTable::none);
  }
}

TEST(PlaceTable, AnEmptyOneFindsNothing) {
  const PlaceTable table;
  const int object = 0;
  EXPECT_EQ(table.find(&object, {}), PlaceTable::none);
}

}  // namespace
}  // namespace boxstream
