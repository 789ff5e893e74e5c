// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstdint>
#include <memory>

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <boxstream/bullet/precision.hpp>
#include <boxstream/detail/export.hpp>
#include <boxstream/executor.hpp>
#include <boxstream/world.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Which proxies get new pairs before createProxy and setAabb return, instead of in calculateOverlappingPairs.
enum class Eager {
  /// Proxies whose client is a btGhostObject: what btKinematicCharacterController relies on. To recognise them, clients
  /// are cast to btCollisionObject, as btGhostPairCallback does: if a call has a dispatcher, and with an own cache that
  /// has a ghost callback. If clients are other objects, use `none`; null and small integers are recognised.
  ghosts,
  all,   ///< every proxy whose box changed: as btDbvtBroadphase does it; each move compares the box with its neighbours
  none,  ///< no proxy; clients are never read, so they may be anything
};

/// How a Broadphase runs, and which pairs it reports.
struct Options {
  /// Runs the search for pairs in parallel; borrowed for the life of the broad-phase. Null: the calling thread does
  /// all. Results do not depend on it. Callbacks always run on the calling thread. For Bullet's own threads there is
  /// <boxstream/bullet/executor.hpp>.
  Executor* executor = nullptr;

  Eager eager = Eager::ghosts;

  /// Added to all six sides of every box when looking for pairs; in world units, 0 or more. Larger values give more
  /// pairs of objects that do not touch; 0.05 is what btDbvtBroadphase adds to boxes that moved.
  btScalar margin = 0;

  /// False: boxes of shapes wider than about two units are larger for pairs, by up to btDbvtBroadphase's 0.05. Bullet
  /// keeps contacts of such shapes at distances that boxes do not cover (a fiftieth of the smaller shape's size), and
  /// they begin as early as with btDbvtBroadphase then. True: boxes are what setAabb got, and these contacts may begin
  /// only when the shapes nearly touch. Sizes are those of shapes, for collision objects, or of boxes; a box is as
  /// given until setAabb is called with a dispatcher.
  bool exact_boxes = false;

  /// How pairs are found, as in WorldOptions; with `Method::hybrid` by a batch of all boxes in each step.
  Method method = Method::planned;
  std::uint32_t cutoff = 0;
};

/// A broad-phase for Bullet worlds that processes all changes in one batch per step:
///
///     auto* broadphase = new boxstream::bullet::Broadphase;   // was: new btDbvtBroadphase
///
/// @par Pairs
/// After calculateOverlappingPairs the pair cache holds exactly the pairs whose boxes, those of wide shapes grown as
/// Options::exact_boxes says, overlap or touch and that the filter accepted when they began. With the own cache they
/// are sorted by creation of their proxies, which is the order of unique ids until these start again. A pair that
/// persists keeps its algorithm and its order of proxies.
///
/// @par Filters
/// Tested when a pair begins, not again while it lasts. Group and mask are read from the proxy, so writing these fields
/// is enough for future pairs. A write is noticed in the next batch if setAabb is called for the proxy, which
/// btCollisionWorld does by default, after refilter(), or if there are up to 128 proxies; otherwise within a batch for
/// each 64 proxies, or for each 16 where no pair has changed for as long. So a batch without a change costs the
/// same with any number of proxies. A refused pair is tested again after a change of the box, group or mask of one of
/// the two, after a filter callback is set (for a borrowed cache: another one), and after refilter(). Refusals take no
/// memory. Unlike with btDbvtBroadphase, pairs that begin by setAabb exist only after calculateOverlappingPairs, except
/// those of ghosts (Options::eager).
///
/// @par Boxes
/// Closed, exact, any finite or infinite size; one with a NaN or min > max pairs with nothing and is found by no query
/// until a later setAabb repairs it. The box fields of a proxy and getAabb hold what was passed last.
///
/// @par Queries
/// rayTest and aabbTest see every earlier call, need no calculateOverlappingPairs, report each proxy once and ignore
/// what the callback returns, as Bullet's own broad-phases do. They may run from any number of threads at once, and may
/// be nested.
///
/// @par Threads
/// Everything but queries and plain reads needs the broad-phase to itself.
///
/// @par Ids
/// m_uniqueId is 1, 2, 3 ... in order of creation, and starts again at resetPool on an empty broad-phase; also after
/// 2^31 - 1, from then on past the ids that are in use.
///
/// @par Contacts
/// Bullet sorts those of a step by island alone, which mixes those of one island, so the order of pairs is not that of
/// the solver. With `world->getDispatchInfo().m_deterministicOverlappingPairs = true` it is: contacts are solved by
/// ids. Stacks that were created from the ground up then stand with less deep contacts; other scenes differ by little
/// more than noise. The own cache has that order already, so steps take no longer. Kinematic objects then wake what
/// they touch, not all that they come near. For stacks that were created in any order there is
/// <boxstream/bullet/low_first.hpp>.
///
/// @par Callbacks
/// Filters, ghosts, contacts that end, near callbacks and queries may query, but should not create, change or destroy
/// proxies, as with Bullet's own. Debug builds assert where they can tell; nothing is corrupted. Pairs that users
/// remove from the cache while they overlap are asked for again, and come back, in the next step.
///
/// @par Memory
/// In bytes, in single (double) precision: 270 (390) a proxy and 40 a pair after shrink_to_fit, and with what batches
/// and queries keep at most 750 (1000) and 60 where pairs last; memory of pairs that are gone goes back within ten
/// batches. While many proxies ask for pairs within their moves, some 300 more a proxy; while few of 33 to 128 or 320
/// proxies move, 9 or 46 kB (13 or 54) more.
///
/// @par Builds
/// For the Bullet whose headers it is compiled with, 2.88 or newer; both come with the CMake targets. One program has
/// one Bullet, in one precision.
///
/// @par Errors
/// Nothing is thrown. Running out of memory, 2^30 pairs, 2^31 proxies at once, and Bullet libraries built with the
/// other floating-point precision, print one line to stderr and abort.
///
/// It does no narrow phase, has no notion of static sets, and does not predict motion.
class BOXSTREAM_API Broadphase : public btBroadphaseInterface {
 public:
  /// `cache` is borrowed and is not touched by the destructor. Null: an own cache, which is faster, because it takes
  /// begun and ended pairs in order and hashes nothing. For a btNullPairCache no pairs are computed, and queries work.
  /// Every other class is taken for one that keeps pairs; what the cache was set to (its callbacks) is left alone.
  explicit Broadphase(btOverlappingPairCache* cache = nullptr, Options options = {});
  explicit Broadphase(const Options& options);
  ~Broadphase() override;
  Broadphase(const Broadphase&) = delete;
  Broadphase& operator=(const Broadphase&) = delete;

  btBroadphaseProxy* createProxy(const btVector3& aabbMin, const btVector3& aabbMax, int shapeType, void* userPtr,
                                 int collisionFilterGroup, int collisionFilterMask, btDispatcher* dispatcher) override;

  /// On return, algorithms are freed, ghosts are notified and pairs removed. Takes one pass over all pairs, at the
  /// speed of memory; with more than a few calls between two batches, time proportional to the number of pairs of
  /// `proxy`.
  void destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;

  /// Costs a compare. Changed boxes are stored and processed together by the next calculateOverlappingPairs or query.
  /// Where boxes go on to move by little, most are known to change no pair, and are not processed but for queries.
  void setAabb(btBroadphaseProxy* proxy, const btVector3& aabbMin, const btVector3& aabbMax,
               btDispatcher* dispatcher) override;
  void getAabb(btBroadphaseProxy* proxy, btVector3& aabbMin, btVector3& aabbMax) const override;

  /// Uses the callback's inverse direction and length, as Bullet's own do; `rayTo` is not read. A proxy is reported
  /// when the ray meets its box grown to [min - aabbMax, max - aabbMin] and by what is added for pairs.
  void rayTest(const btVector3& rayFrom, const btVector3& rayTo, btBroadphaseRayCallback& rayCallback,
               const btVector3& aabbMin = btVector3(0, 0, 0), const btVector3& aabbMax = btVector3(0, 0, 0)) override;
  void aabbTest(const btVector3& aabbMin, const btVector3& aabbMax, btBroadphaseAabbCallback& callback) override;

  /// Reports proxies whose boxes are not wholly behind any of `count` planes; point x is behind plane i when
  /// normals[i].dot(x) + offsets[i] < 0, see boxstream::is_behind. Six inward planes make a view frustum. Replaces
  /// btDbvt::collideKDOP on btDbvtBroadphase's sets, without its limit of 32 planes. Threads as for aabbTest.
  void planesTest(const btVector3* normals, const btScalar* offsets, int count,
                  btBroadphaseAabbCallback& callback) const;

  void calculateOverlappingPairs(btDispatcher* dispatcher) override;
  btOverlappingPairCache* getOverlappingPairCache() override;
  const btOverlappingPairCache* getOverlappingPairCache() const override;

  /// The smallest box that contains all proxies with a valid box; zero if there are none.
  void getBroadphaseAabb(btVector3& aabbMin, btVector3& aabbMax) const override;

  /// On an empty broad-phase: forgets all history, so that the same calls give the same results again, and gives all
  /// memory back. Otherwise nothing.
  void resetPool(btDispatcher* dispatcher) override;

  /// Gives back what memory the proxies and pairs that are here do not need. The next batch and the next query make
  /// what they need anew, so that this is for times when little moves.
  void shrink_to_fit();

  /// For filter callbacks whose answers have changed, and after groups or masks were written: the next
  /// calculateOverlappingPairs tests all refused pairs again. Pairs that are held stay;
  /// btCollisionWorld::refreshBroadphaseProxy ends those of one object.
  void refilter();

  /// Prints nothing, as Bullet's own; see stats().
  void printStats() override;

  /// What the last calculateOverlappingPairs did. Boxes of which it was clear that they change no pair count as at
  /// rest.
  const WorldStats& stats() const;

  /// Checks every internal invariant; for tests. Throws std::logic_error with the first one broken.
  void validate() const;

  // For programs written for btDbvtBroadphase; these calls do nothing. m_deferedcollide is always true here: drop that
  // line.
  void optimize() {}
  void setVelocityPrediction(btScalar) {}
  btScalar getVelocityPrediction() const { return 0; }
  void setAabbForceUpdate(btBroadphaseProxy* proxy, const btVector3& aabbMin, const btVector3& aabbMax,
                          btDispatcher* dispatcher) {
    setAabb(proxy, aabbMin, aabbMax, dispatcher);
  }

 private:
  struct BOXSTREAM_LOCAL Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
