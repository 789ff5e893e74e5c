// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>

#include <boxstream/pair.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "formats/record/op.hpp"
#include "formats/record/pair_limit.hpp"

namespace boxstream::record {

/// Makes the calls of a stream to a broad-phase, with no world and no dispatcher around it. Clients are numbers, not
/// objects: there must be no ghost callback.
///
/// Does not check anything: ops must be those of a Reader, and boxes such that the broad-phase survives them. Bullet's
/// sweep and prune does not survive a NaN or min > max.
class Player {
 public:
  Player(std::string name, std::unique_ptr<btBroadphaseInterface> broadphase,
         std::uint64_t most_pairs = usual_most_pairs);
  /// Ends all pairs and destroys all proxies.
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  const std::string& name() const { return name_; }

  /// Throws RecordError if the broad-phase is full, or has come to hold more than `most_pairs`. One call can find more
  /// by then: where a broad-phase finds all at a batch, its caller has to know that they are not too many.
  void apply(const Op& op);

  /// The pairs that the broad-phase holds, sorted; those of near misses and any that are held twice included.
  std::vector<Pair> held() const;

  /// What each box query since the last call of this reported, sorted by id, near misses and repetitions included.
  std::vector<std::vector<std::uint32_t>> take_hits();

 private:
  void call(const Create& op);
  void call(const Move& op);
  void call(const Destroy& op);
  void call(const Refilter& op);
  void call(const BoxQuery& op);
  void call(const RayQuery& op);
  void call(const Batch& op);
  void call(const ResetPool& op);

  std::string name_;
  std::unique_ptr<btBroadphaseInterface> broadphase_;
  std::uint64_t most_pairs_;
  std::vector<btBroadphaseProxy*> proxies_;  // by id; null when destroyed
  std::vector<std::vector<std::uint32_t>> hits_;
};

}  // namespace boxstream::record
