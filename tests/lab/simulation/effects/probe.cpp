// SPDX-License-Identifier: MIT
#include "probe.hpp"

#include <algorithm>
#include <memory>

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <LinearMath/btQuickprof.h>
#include <btBulletDynamicsCommon.h>

#include "formats/record/forwarding_broadphase.hpp"
#include "simulation/engine/contacts/unit_contacts.hpp"
#include "simulation/run/simulation.hpp"

// Bullet's own counters, which no header declares.
extern int gNumClampedCcdMotions;
extern int gNumSplitImpulseRecoveries;

namespace boxstream::effects_test {
namespace {

using scenes::Simulation;

class CountingBroadphase final : public record::ForwardingBroadphase {
 public:
  CountingBroadphase(std::unique_ptr<btBroadphaseInterface> inner, Counts& counts)
      : ForwardingBroadphase(std::move(inner)), counts_(counts) {}

  void setAabb(btBroadphaseProxy* proxy, const btVector3& lo, const btVector3& hi, btDispatcher* dispatcher) override {
    const auto& object = *static_cast<const btCollisionObject*>(proxy->m_clientObject);
    ++counts_["boxes set"];
    if (object.getActivationState() == ISLAND_SLEEPING) ++counts_["boxes of sleepers set"];
    ForwardingBroadphase::setAabb(proxy, lo, hi, dispatcher);
  }
  void rayTest(const btVector3& from, const btVector3& to, btBroadphaseRayCallback& callback, const btVector3& lo,
               const btVector3& hi) override {
    ++counts_["rays"];
    ForwardingBroadphase::rayTest(from, to, callback, lo, hi);
  }
  void aabbTest(const btVector3& lo, const btVector3& hi, btBroadphaseAabbCallback& callback) override {
    ++counts_["box queries"];
    ForwardingBroadphase::aabbTest(lo, hi, callback);
  }
  void calculateOverlappingPairs(btDispatcher* dispatcher) override {
    ++counts_["searches for pairs"];
    ForwardingBroadphase::calculateOverlappingPairs(dispatcher);
  }
  void destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override {
    ++counts_["objects taken out"];
    ForwardingBroadphase::destroyProxy(proxy, dispatcher);
  }

 private:
  Counts& counts_;
};

/// Opens what Bullet keeps to itself.
struct Open : btDiscreteDynamicsWorld {
  static int actions(btDiscreteDynamicsWorld& world) { return (world.*&Open::m_actions).size(); }
};
struct OpenCache : btHashedOverlappingPairCache {
  static bool has_ghost_callback(btOverlappingPairCache& cache) {
    return dynamic_cast<btHashedOverlappingPairCache&>(cache).*&OpenCache::m_ghostPairCallback != nullptr;
  }
};

void keep_most(double& most, double value) {
  most = std::max(most, value);
}

void count_bodies(const Simulation& simulation, Counts& counts) {
  for (const btCollisionObject* const object : simulation.objects()) {
    const btRigidBody* const body = btRigidBody::upcast(object);
    if (body == nullptr) continue;
    counts["bodies whose contacts are found in units"] += scenes::UnitContacts::is_marked(*body);
    counts["bodies that are swept"] += body->getCcdMotionThreshold() > 0;
    counts["kinematic bodies"] += body->isKinematicObject();
    counts["bodies with friction"] += body->getFriction() > 0;
    counts["bodies with anisotropic friction"] += body->hasAnisotropicFriction();
    counts["bodies with rolling friction"] += body->getRollingFriction() > btScalar(1e-20);
    counts["bodies with spinning friction"] += body->getSpinningFriction() > 0;
    counts["bodies that bounce"] += body->getRestitution() > 0;
    counts["bodies with damping"] += body->getLinearDamping() > 0 || body->getAngularDamping() > 0;
    counts["bodies that fall"] += !body->getGravity().isZero();
    counts["bodies with a contact callback"] +=
        (body->getCollisionFlags() & btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK) != 0;
    counts["bodies that ignore others"] += body->getNumObjectsWithoutCollision() > 0;
    const btBroadphaseProxy* const proxy = body->getBroadphaseHandle();
    if (proxy == nullptr) continue;
    const int group =
        body->isStaticOrKinematicObject() ? btBroadphaseProxy::StaticFilter : btBroadphaseProxy::DefaultFilter;
    counts["bodies with a group of their own"] += proxy->m_collisionFilterGroup != group;
    switch (body->getCollisionShape()->getShapeType()) {
      case STATIC_PLANE_PROXYTYPE:
        ++counts["planes"];
        break;
      case TERRAIN_SHAPE_PROXYTYPE:
        ++counts["height fields"];
        break;
      case TRIANGLE_MESH_SHAPE_PROXYTYPE:
        ++counts["meshes"];
        break;
      case COMPOUND_SHAPE_PROXYTYPE:
        ++counts["compounds"];
        break;
      default:
        break;
    }
  }
}

void count_world(Simulation& simulation, Counts& counts) {
  auto& world = static_cast<btDiscreteDynamicsWorld&>(simulation.world());
  counts["soft worlds"] = world.getWorldType() == BT_SOFT_RIGID_DYNAMICS_WORLD;
  counts["constraints"] = world.getNumConstraints();
  counts["actions"] = Open::actions(world);
  counts["contact callbacks"] = gContactAddedCallback != nullptr;
  counts["split impulse"] = world.getSolverInfo().m_splitImpulse;
  counts["friction caching"] = (world.getSolverInfo().m_solverMode & SOLVER_ENABLE_FRICTION_DIRECTION_CACHING) != 0;
  counts["swept boxes"] = world.getDispatchInfo().m_useContinuous;
}

const char* const all_counters[] = {"boxes set",
                                    "boxes of sleepers set",
                                    "rays",
                                    "box queries",
                                    "searches for pairs",
                                    "objects taken out",
                                    "manifolds",
                                    "contact rows",
                                    "friction rows",
                                    "rolling rows",
                                    "joint rows",
                                    "limit rows",
                                    "motor rows",
                                    "rows of another solver",
                                    "ghost pairs",
                                    "sleeping bodies",
                                    "clamped motions",
                                    "split impulse recoveries",
                                    "bodies whose contacts are found in units",
                                    "bodies that are swept",
                                    "kinematic bodies",
                                    "bodies with friction",
                                    "bodies with anisotropic friction",
                                    "bodies with rolling friction",
                                    "bodies with spinning friction",
                                    "bodies that bounce",
                                    "bodies with damping",
                                    "bodies that fall",
                                    "bodies with a contact callback",
                                    "bodies that ignore others",
                                    "bodies with a group of their own",
                                    "planes",
                                    "height fields",
                                    "meshes",
                                    "compounds"};

}  // namespace

Counts count(const scenes::Scene& scene, effects::Extent extent) {
  Counts counts;
  for (const char* const name : all_counters) counts[name] = 0;
  for (const effects::Effect* const effect : effects::all_effects())
    counts[std::string("hooks of ") + effect->name] = 0;
  gContactAddedCallback = nullptr;
  gNumClampedCcdMotions = gNumSplitImpulseRecoveries = 0;
  Counts calls = counts;
  {
    Simulation simulation(
        scene, "boxstream", [&](auto inner) { return std::make_unique<CountingBroadphase>(std::move(inner), calls); },
        extent);
    calls = counts;  // those of the building do not count
    for (int i = 0; i < scene.time.steps; ++i) {
      const scenes::StepResult result = simulation.step();
      keep_most(calls["manifolds"], simulation.world().getDispatcher()->getNumManifolds());
      keep_most(calls["ghost pairs"], static_cast<double>(result.ghost_overlaps));
      keep_most(calls["sleeping bodies"], simulation.metric(scenes::Check::Metric::sleeping));
    }
    counts = calls;
    const scenes::SolverRows& rows = simulation.solver_rows();
    counts["contact rows"] = static_cast<double>(rows.contact);
    counts["friction rows"] = static_cast<double>(rows.friction);
    counts["rolling rows"] = static_cast<double>(rows.rolling);
    counts["joint rows"] = static_cast<double>(rows.joint);
    counts["limit rows"] = static_cast<double>(rows.acting_limit);
    counts["motor rows"] = static_cast<double>(rows.acting_motor);
    counts["rows of another solver"] = static_cast<double>(rows.other);
    for (const scenes::HookCalls& hook : simulation.hook_calls())
      counts["hooks of " + hook.effect] += static_cast<double>(hook.calls);
    count_bodies(simulation, counts);
    count_world(simulation, counts);
  }
  // Bullet's own cache shows what it was given.
  Simulation other(scene, "dbvt", {}, extent);
  counts["ghost callbacks"] = OpenCache::has_ghost_callback(*other.broadphase().getOverlappingPairCache());
  counts["clamped motions"] = gNumClampedCcdMotions;
  counts["split impulse recoveries"] = gNumSplitImpulseRecoveries;
  return counts;
}

namespace {

std::map<std::string, std::uint64_t>* zones = nullptr;

}  // namespace

std::map<std::string, std::uint64_t> count_zones(const scenes::Scene& scene) {
  std::map<std::string, std::uint64_t> found;
  Simulation simulation(scene, "boxstream");
  btEnterProfileZoneFunc* const enter = btGetCurrentEnterProfileZoneFunc();
  btLeaveProfileZoneFunc* const leave = btGetCurrentLeaveProfileZoneFunc();
  zones = &found;
  btSetCustomEnterProfileZoneFunc([](const char* name) { ++(*zones)[name]; });
  btSetCustomLeaveProfileZoneFunc([] {});
  for (int i = 0; i < scene.time.steps; ++i) simulation.advance();
  btSetCustomEnterProfileZoneFunc(enter);
  btSetCustomLeaveProfileZoneFunc(leave);
  return found;
}

}  // namespace boxstream::effects_test
