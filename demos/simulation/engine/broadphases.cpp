// SPDX-License-Identifier: MIT
#include "simulation/engine/broadphases.hpp"

#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/BroadphaseCollision/btSimpleBroadphase.h>
#include <algorithm>
#include <boxstream/bullet.hpp>

#include "base/words.hpp"
#include "formats/scene_model/names.hpp"
#include "simulation/engine/convert.hpp"

#ifdef BOXSTREAM_SCENES_HAVE_TBB
#include <boxstream/tbb.hpp>
#else
#include <stdexcept>
#endif

namespace boxstream::scenes {
namespace {

/// Bullet's own leaves the box fields of a new proxy unset until its first setAabb, which static bodies never get.
class Sap final : public bt32BitAxisSweep3 {
 public:
  using bt32BitAxisSweep3::bt32BitAxisSweep3;

  btBroadphaseProxy* createProxy(const btVector3& aabb_min, const btVector3& aabb_max, int shape_type, void* client,
                                 int group, int mask, btDispatcher* dispatcher) override {
    btBroadphaseProxy* const proxy =
        bt32BitAxisSweep3::createProxy(aabb_min, aabb_max, shape_type, client, group, mask, dispatcher);
    proxy->m_aabbMin = aabb_min;
    proxy->m_aabbMax = aabb_max;
    return proxy;
  }
};

}  // namespace

std::unique_ptr<btBroadphaseInterface> make_broadphase(const std::string& name, const Bounds& bounds,
                                                       std::size_t max_objects, Executor* executor) {
  if (name == "boxstream" || name == "hybrid") {
    boxstream::bullet::Options options;
    if (name == "hybrid") options.method = Method::hybrid;
    options.executor = executor;
    return std::make_unique<boxstream::bullet::Broadphase>(options);
  }
  if (name == "dbvt") return std::make_unique<btDbvtBroadphase>();
  if (name == "dbvt-deferred") {
    auto dbvt = std::make_unique<btDbvtBroadphase>();
    dbvt->m_deferedcollide = true;
    return dbvt;
  }
  if (name == "sap")
    return std::make_unique<Sap>(vector(bounds.min), vector(bounds.max), static_cast<unsigned>(max_objects) + 1);
  if (name == "simple") return std::make_unique<btSimpleBroadphase>(static_cast<int>(max_objects));
  throw UnknownBroadphase(unknown_word("broad-phase", name, broadphase_names()));
}

std::unique_ptr<Executor> make_executor(int threads) {
#ifdef BOXSTREAM_SCENES_HAVE_TBB
  return std::make_unique<TbbExecutor>(threads);
#else
  throw std::runtime_error("a search on " + std::to_string(threads) + " threads takes a build with oneTBB");
#endif
}

}  // namespace boxstream::scenes
