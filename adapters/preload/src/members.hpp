// SPDX-License-Identifier: MIT
// The functions of Bullet and FCL that are replaced, by the names under which their libraries export them. All take
// words alone: pointers, references, integers. So one list serves both precisions of Bullet.
#pragma once

#include <cstdint>

namespace boxstream::preload {

using Word = std::uintptr_t;

/// The arguments of a call, `this` first. Those that a function does not have hold anything.
struct Words {
  Word at[8];
};

using Function = Word (*)(Word, Word, Word, Word, Word, Word, Word, Word);

inline Word call(Function function, const Words& w) {
  return function(w.at[0], w.at[1], w.at[2], w.at[3], w.at[4], w.at[5], w.at[6], w.at[7]);
}

/// What a call is counted as.
enum class Kind : std::uint8_t { made, ended, change, batch, query, other, count };

}  // namespace boxstream::preload

// X(engine class, member, kind, exported name)
#define BOXSTREAM_PRELOAD_BULLET(X)                                                                               \
  X(dbvt, construct, made, "_ZN16btDbvtBroadphaseC1EP22btOverlappingPairCache")                                   \
  X(dbvt, construct_base, made, "_ZN16btDbvtBroadphaseC2EP22btOverlappingPairCache")                              \
  X(dbvt, destroy_and_free, ended, "_ZN16btDbvtBroadphaseD0Ev")                                                   \
  X(dbvt, destroy, ended, "_ZN16btDbvtBroadphaseD1Ev")                                                            \
  X(dbvt, destroy_base, ended, "_ZN16btDbvtBroadphaseD2Ev")                                                       \
  X(dbvt, create_proxy, change, "_ZN16btDbvtBroadphase11createProxyERK9btVector3S2_iPviiP12btDispatcher")         \
  X(dbvt, destroy_proxy, change, "_ZN16btDbvtBroadphase12destroyProxyEP17btBroadphaseProxyP12btDispatcher")       \
  X(dbvt, set_aabb, change, "_ZN16btDbvtBroadphase7setAabbEP17btBroadphaseProxyRK9btVector3S4_P12btDispatcher")   \
  X(dbvt, set_aabb_force_update, change,                                                                          \
    "_ZN16btDbvtBroadphase18setAabbForceUpdateEP17btBroadphaseProxyRK9btVector3S4_P12btDispatcher")               \
  X(dbvt, ray_test, query, "_ZN16btDbvtBroadphase7rayTestERK9btVector3S2_R23btBroadphaseRayCallbackS2_S2_")       \
  X(dbvt, aabb_test, query, "_ZN16btDbvtBroadphase8aabbTestERK9btVector3S2_R24btBroadphaseAabbCallback")          \
  X(dbvt, calculate_overlapping_pairs, batch, "_ZN16btDbvtBroadphase25calculateOverlappingPairsEP12btDispatcher") \
  X(dbvt, collide, batch, "_ZN16btDbvtBroadphase7collideEP12btDispatcher")                                        \
  X(dbvt, get_aabb, other, "_ZNK16btDbvtBroadphase7getAabbEP17btBroadphaseProxyR9btVector3S3_")                   \
  X(dbvt, get_broadphase_aabb, other, "_ZNK16btDbvtBroadphase17getBroadphaseAabbER9btVector3S1_")                 \
  X(dbvt, get_cache, other, "_ZN16btDbvtBroadphase23getOverlappingPairCacheEv")                                   \
  X(dbvt, get_cache_const, other, "_ZNK16btDbvtBroadphase23getOverlappingPairCacheEv")                            \
  X(dbvt, optimize, other, "_ZN16btDbvtBroadphase8optimizeEv")                                                    \
  X(dbvt, perform_deferred_removal, other, "_ZN16btDbvtBroadphase22performDeferredRemovalEP12btDispatcher")       \
  X(dbvt, print_stats, other, "_ZN16btDbvtBroadphase10printStatsEv")                                              \
  X(dbvt, reset_pool, other, "_ZN16btDbvtBroadphase9resetPoolEP12btDispatcher")

// What Bullet's library exports of sweep and prune is made, but not replaced: programs compile the rest themselves.
#define BOXSTREAM_PRELOAD_SWEEPS(X)                                                                       \
  X(sweep, construct, made, "_ZN12btAxisSweep3C1ERK9btVector3S2_tP22btOverlappingPairCacheb")             \
  X(sweep, construct_base, made, "_ZN12btAxisSweep3C2ERK9btVector3S2_tP22btOverlappingPairCacheb")        \
  X(sweep_32_bit, construct, made, "_ZN17bt32BitAxisSweep3C1ERK9btVector3S2_jP22btOverlappingPairCacheb") \
  X(sweep_32_bit, construct_base, made, "_ZN17bt32BitAxisSweep3C2ERK9btVector3S2_jP22btOverlappingPairCacheb")

// X(engine class, member, kind, exported name) for each manager of FCL, whose members have one list.
#define BOXSTREAM_PRELOAD_FCL_OF(X, manager, name)                                                            \
  X(manager, construct, made, "_ZN3fcl" name "C1Ev")                                                          \
  X(manager, construct_base, made, "_ZN3fcl" name "C2Ev")                                                     \
  X(manager, destroy_and_free, ended, "_ZN3fcl" name "D0Ev")                                                  \
  X(manager, destroy, ended, "_ZN3fcl" name "D1Ev")                                                           \
  X(manager, destroy_base, ended, "_ZN3fcl" name "D2Ev")                                                      \
  X(manager, register_object, change, "_ZN3fcl" name "14registerObjectEPNS_15CollisionObjectIdEE")            \
  X(manager, register_objects, change,                                                                        \
    "_ZN3fcl" name "15registerObjectsERKSt6vectorIPNS_15CollisionObjectIdEESaIS5_EE")                         \
  X(manager, unregister_object, change, "_ZN3fcl" name "16unregisterObjectEPNS_15CollisionObjectIdEE")        \
  X(manager, setup, change, "_ZN3fcl" name "5setupEv")                                                        \
  X(manager, update_all, change, "_ZN3fcl" name "6updateEv")                                                  \
  X(manager, update_one, change, "_ZN3fcl" name "6updateEPNS_15CollisionObjectIdEE")                          \
  X(manager, update_some, change, "_ZN3fcl" name "6updateERKSt6vectorIPNS_15CollisionObjectIdEESaIS5_EE")     \
  X(manager, clear, change, "_ZN3fcl" name "5clearEv")                                                        \
  X(manager, get_objects, other, "_ZNK3fcl" name "10getObjectsERSt6vectorIPNS_15CollisionObjectIdEESaIS5_EE") \
  X(manager, size, other, "_ZNK3fcl" name "4sizeEv")                                                          \
  X(manager, empty, other, "_ZNK3fcl" name "5emptyEv")                                                        \
  X(manager, collide_all, batch, "_ZNK3fcl" name "7collideEPvPFbPNS_15CollisionObjectIdEES5_S2_E")            \
  X(manager, collide_one, query, "_ZNK3fcl" name "7collideEPNS_15CollisionObjectIdEEPvPFbS4_S4_S5_E")         \
  X(manager, collide_other, batch,                                                                            \
    "_ZNK3fcl" name "7collideEPNS_26BroadPhaseCollisionManagerIdEEPvPFbPNS_15CollisionObjectIdEES8_S5_E")     \
  X(manager, distance_all, batch, "_ZNK3fcl" name "8distanceEPvPFbPNS_15CollisionObjectIdEES5_S2_RdE")        \
  X(manager, distance_one, query, "_ZNK3fcl" name "8distanceEPNS_15CollisionObjectIdEEPvPFbS4_S4_S5_RdE")     \
  X(manager, distance_other, batch,                                                                           \
    "_ZNK3fcl" name "8distanceEPNS_26BroadPhaseCollisionManagerIdEEPvPFbPNS_15CollisionObjectIdEES8_S5_RdE")

#define BOXSTREAM_PRELOAD_FCL(X)                                                        \
  BOXSTREAM_PRELOAD_FCL_OF(X, tree, "31DynamicAABBTreeCollisionManagerIdE")             \
  BOXSTREAM_PRELOAD_FCL_OF(X, array_tree, "37DynamicAABBTreeCollisionManager_ArrayIdE") \
  BOXSTREAM_PRELOAD_FCL_OF(X, interval_tree, "28IntervalTreeCollisionManagerIdE")       \
  BOXSTREAM_PRELOAD_FCL_OF(X, naive, "21NaiveCollisionManagerIdE")                      \
  BOXSTREAM_PRELOAD_FCL_OF(X, ssap, "20SSaPCollisionManagerIdE")                        \
  BOXSTREAM_PRELOAD_FCL_OF(X, sap, "19SaPCollisionManagerIdE")

namespace boxstream::preload {

enum class BulletMember : unsigned {
#define X(manager, member, kind, name) member,
  BOXSTREAM_PRELOAD_BULLET(X)
#undef X
};

enum class FclMember : unsigned {
#define X(manager, member, kind, name) member,
  BOXSTREAM_PRELOAD_FCL_OF(X, , "")
#undef X
};

enum class FclManager : unsigned { tree, array_tree, interval_tree, naive, ssap, sap };

}  // namespace boxstream::preload
