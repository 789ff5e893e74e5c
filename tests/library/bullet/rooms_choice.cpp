// SPDX-License-Identifier: MIT
#include "rooms_choice.hpp"

#include <gtest/gtest.h>

namespace boxstream::bullet {
namespace {

/// Batches of a world, calm ones, in which so many boxes leave their rooms.
struct World {
  std::size_t proxies;
  RoomsChoice choice = {};

  /// How many of so many batches have rooms.
  std::size_t with_rooms(std::size_t batches, std::size_t exits) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < batches; ++i) {
      if (are_open) {
        ++count;
        are_open = choice.go_on(proxies / 2, exits, exits / 16, room_prices::search(proxies));
        if (!are_open) choice.closed();
      } else if (choice.opens(proxies, true)) {
        choice.opened(proxies);
        are_open = true;
        ++openings;
      }
    }
    return count;
  }
  bool are_open = false;
  std::size_t openings = 0;
};

TEST(RoomsChoice, StayWhereFewBoxesLeaveThem) {
  for (const std::size_t proxies : {30, 1000, 4096}) {
    World world{proxies};
    EXPECT_GE(world.with_rooms(1000, proxies / 100), 980u) << proxies;
    EXPECT_EQ(world.openings, 1u) << proxies;
  }
}

/// The time that is lost by openings is a small part of that of all batches, whatever the number of boxes is.
TEST(RoomsChoice, AreOpenedLessAndLessOftenWhereTheyDoNotPay) {
  for (const std::size_t proxies : {300, 1000, 4096}) {
    World world{proxies};
    world.with_rooms(2560, proxies / 10);
    const std::size_t at_first = world.openings;
    EXPECT_LE(at_first, 8u) << proxies;
    world.with_rooms(12800, proxies / 10);
    const std::size_t later = world.openings - at_first;
    EXPECT_LE(later, 10u) << proxies;
    EXPECT_LE(later * room_prices::opening(proxies), 12800 * room_prices::search(proxies) / 50) << proxies;
    // A pile that has come to rest has them all the same.
    EXPECT_GE(world.with_rooms(12800, proxies / 100), 11400u) << proxies;
  }
}

TEST(RoomsChoice, AreNotOpenedBeyondCaches) {
  World world{4097};
  EXPECT_EQ(world.with_rooms(12800, 0), 0u);
}

TEST(RoomsChoice, ABatchOfManyDoesNotEndThem) {
  World world{1000};
  ASSERT_GT(world.with_rooms(100, 5), 0u);
  EXPECT_EQ(world.with_rooms(1, 200), 1u);
  EXPECT_EQ(world.with_rooms(100, 5), 100u);
  EXPECT_LT(world.with_rooms(100, 300), 20u);
}

}  // namespace
}  // namespace boxstream::bullet
