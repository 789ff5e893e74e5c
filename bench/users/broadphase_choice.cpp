// SPDX-License-Identifier: MIT
#include "users/broadphase_choice.hpp"

#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <stdexcept>

namespace boxstream::bench {

namespace {

/// Bullet's own leaves the box fields of a new proxy unset until its first setAabb, which static bodies may never get.
template <class AxisSweep>
class Sap final : public AxisSweep {
 public:
  using AxisSweep::AxisSweep;

  btBroadphaseProxy* createProxy(const btVector3& low, const btVector3& high, int shape, void* client, int group,
                                 int mask, btDispatcher* dispatcher) override {
    btBroadphaseProxy* const proxy = AxisSweep::createProxy(low, high, shape, client, group, mask, dispatcher);
    proxy->m_aabbMin = low;
    proxy->m_aabbMax = high;
    return proxy;
  }
};

constexpr std::size_t most_in_sap16 = 16383;

}  // namespace

std::unique_ptr<btBroadphaseInterface> make_broadphase(const BroadphaseChoice& choice, double reach, std::size_t most) {
  const auto side = static_cast<btScalar>(reach);
  const btVector3 low(-side, -side, -side), high(side, side, side);
  if (choice.name == "boxstream" || choice.name == "hybrid") {
    bullet::Options options;
    if (choice.name == "hybrid") options.method = Method::hybrid;
    options.eager = choice.eager;
    return std::make_unique<bullet::Broadphase>(choice.cache, options);
  }
  if (choice.name == "dbvt") return std::make_unique<btDbvtBroadphase>(choice.cache);
  if (choice.name == "dbvt-deferred") {
    auto dbvt = std::make_unique<btDbvtBroadphase>(choice.cache);
    dbvt->m_deferedcollide = true;
    return dbvt;
  }
  if (choice.name == "sap16")
    return std::make_unique<Sap<btAxisSweep3>>(low, high, static_cast<unsigned short>(most + 1), choice.cache);
  if (choice.name == "sap")
    return std::make_unique<Sap<bt32BitAxisSweep3>>(low, high, static_cast<unsigned>(most + 1), choice.cache);
  throw std::invalid_argument("no broad-phase '" + choice.name +
                              "'; there are hybrid, dbvt, dbvt-deferred, sap16, sap");
}

bool can_hold(const std::string& name, std::size_t objects) {
  return name != "sap16" || objects < most_in_sap16;
}

}  // namespace boxstream::bench
