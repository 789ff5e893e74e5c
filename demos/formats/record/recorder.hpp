// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "formats/record/forwarding_broadphase.hpp"
#include "formats/record/writer.hpp"

namespace boxstream::record {

/// The precision of this build of Bullet: what streams recorded and replayed here hold.
inline constexpr Scalar bullet_scalar = sizeof(btScalar) == 4 ? Scalar::float32 : Scalar::float64;

/// Records every call that a world makes to a broad-phase, and passes it on. The world behaves as without it.
///
/// Filters are plain fields of proxies: that they were written is noticed when the proxy moves, and at the next batch.
/// Not recorded: filter and ghost callbacks, pairs that users take out of the cache, and the identity of clients.
/// Threads: as the broad-phase behind; queries from several at once are recorded in the order in which they came.
/// Errors of the file stay in the writer's stream. Running out of memory throws std::bad_alloc into the caller.
class Recorder final : public ForwardingBroadphase {
 public:
  /// Borrows `writer`, made for `bullet_scalar`; call its `finish` before the world is taken down, which a recording
  /// leaves out.
  Recorder(std::unique_ptr<btBroadphaseInterface> inner, Writer& writer);

  btBroadphaseProxy* createProxy(const btVector3& lo, const btVector3& hi, int shape_type, void* client, int group,
                                 int mask, btDispatcher* dispatcher) override;
  void destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;
  void setAabb(btBroadphaseProxy* proxy, const btVector3& lo, const btVector3& hi, btDispatcher* dispatcher) override;
  void rayTest(const btVector3& from, const btVector3& to, btBroadphaseRayCallback& callback, const btVector3& lo,
               const btVector3& hi) override;
  void aabbTest(const btVector3& lo, const btVector3& hi, btBroadphaseAabbCallback& callback) override;
  void calculateOverlappingPairs(btDispatcher* dispatcher) override;
  void resetPool(btDispatcher* dispatcher) override;

 private:
  struct Known {
    const btBroadphaseProxy* proxy;
    std::uint32_t id;
    int group;
    int mask;
    Aabb64 box;
  };

  Known& known(const btBroadphaseProxy* proxy) { return live_[places_.at(proxy)]; }
  void note_filter(Known& known);
  PairDigest overlapping_pairs() const;
  void write(const Op& op);

  Writer& writer_;
  std::mutex writing_;  // queries may come from many threads
  std::uint32_t created_ = 0;
  std::vector<Known> live_;
  std::unordered_map<const btBroadphaseProxy*, std::size_t> places_;  // in live_
};

}  // namespace boxstream::record
