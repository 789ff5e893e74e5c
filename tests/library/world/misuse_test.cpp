// SPDX-License-Identifier: MIT
// Debug builds notice a World that is changed while it is in use: inside a callback of its own, or by another thread.
#include <gtest/gtest.h>

#include <functional>
#include <thread>

#include <boxstream/world.hpp>

#ifndef NDEBUG
namespace boxstream::tests {
namespace {

constexpr Aabb unit{{0, 0, 0}, {1, 1, 1}};

struct Use {
  World world;
  ProxyId a = world.create(unit), b = world.create(unit), c = world.create(unit);
};

const std::function<void(Use&)> changes[] = {
    [](Use& u) { u.world.create(unit); },      [](Use& u) { u.world.move(u.a, {{5, 5, 5}, {6, 6, 6}}); },
    [](Use& u) { u.world.destroy(u.b); },      [](Use& u) { u.world.set_filter(u.a, {1, 0}); },
    [](Use& u) { u.world.release(u.a, u.b); }, [](Use& u) { u.world.update(); },
    [](Use& u) { u.world.clear(); },
};

TEST(Misuse, ChangesInsideCallbacksAreNoticed) {
  for (const auto& change : changes) {
    EXPECT_DEATH(
        {
          Use u;
          u.world.update([&](ProxyId, ProxyId) {
            change(u);
            return true;
          });
        },
        "changed by two at once, or inside a callback");
    EXPECT_DEATH(
        {
          Use u;
          u.world.query_box(unit, [&](ProxyId) {
            change(u);
            return true;
          });
        },
        "changed by two at once, or inside a callback");
    EXPECT_DEATH(
        {
          Use u;
          u.world.update();
          u.world.for_each_pair([&](ProxyPair) {
            change(u);
            return true;
          });
        },
        "changed by two at once, or inside a callback");
  }
}

TEST(Misuse, ChangesByAnotherThreadAreNoticed) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(
      {
        Use u;
        u.world.query_box(unit, [&](ProxyId) {
          std::thread([&] { u.world.move(u.a, unit); }).join();
          return true;
        });
      },
      "changed by two at once, or inside a callback");
  EXPECT_DEATH(
      {
        Use u;
        u.world.update([&](ProxyId, ProxyId) {
          std::thread([&] { u.world.bounds(); }).join();
          return true;
        });
      },
      "read while another thread changes it");
}

}  // namespace
}  // namespace boxstream::tests
#endif
