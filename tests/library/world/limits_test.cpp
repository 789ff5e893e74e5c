// SPDX-License-Identifier: MIT
// More proxies than 32-bit ranks can name.
#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>

#include <boxstream/world.hpp>

namespace boxstream::tests {
namespace {

/// No machine of ours holds that many: the number is refused before a box is read or an id written.
TEST(Limits, MoreProxiesThanRanksAreAnErrorAndChangeNothing) {
  const Aabb box{{0, 0, 0}, {1, 1, 1}};
  World world;
  world.create(box);
  const ProxyId second = world.create(box);
  ProxyId id = second;
  for (const std::uint64_t count : {std::uint64_t{UINT32_MAX} - 2, std::uint64_t{UINT32_MAX}, std::uint64_t{1} << 32}) {
    if (count > SIZE_MAX) break;
    const auto size = static_cast<std::size_t>(count);
    EXPECT_THROW(world.create(Span<const Aabb>(&box, size), {}, Span<ProxyId>(&id, size)), std::length_error);
  }
  EXPECT_EQ(id, second);
  EXPECT_EQ(world.size(), 2u);
  world.validate();
  EXPECT_EQ(world.update().pairs, 1u);
}

}  // namespace
}  // namespace boxstream::tests
