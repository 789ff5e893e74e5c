// SPDX-License-Identifier: MIT
#include "engine/broadphases.hpp"

#include <algorithm>

#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/BroadphaseCollision/btSimpleBroadphase.h>
#include <boxstream/bullet.hpp>

#include "engine/convert.hpp"
#include "scene/broadphase_names.hpp"

namespace boxstream::scenes {

std::unique_ptr<btBroadphaseInterface> make_broadphase(const std::string& name, const Bounds& bounds,
                                                       std::size_t max_objects, Executor* executor) {
  if (name == "boxstream") {
    boxstream::bullet::Options options;
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
    return std::make_unique<bt32BitAxisSweep3>(vector(bounds.min), vector(bounds.max),
                                               static_cast<unsigned>(max_objects) + 1);
  if (name == "simple") return std::make_unique<btSimpleBroadphase>(static_cast<int>(max_objects));
  std::string known;
  for (const std::string& other : broadphase_names()) known += (known.empty() ? "" : ", ") + other;
  throw UnknownBroadphase("unknown broad-phase \"" + name + "\" (known: " + known + ")");
}

}  // namespace boxstream::scenes
