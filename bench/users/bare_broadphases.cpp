// SPDX-License-Identifier: MIT
#include "users/bare_broadphases.hpp"

#include <fmt/core.h>

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "formats/scene_model/random.hpp"
#include "peers/pair_hash.hpp"
#include "suites/race.hpp"
#include "users/broadphase_choice.hpp"

namespace boxstream::bench {

namespace {

constexpr int movers_among_refused = 50;

using BareFrame = std::vector<std::pair<btVector3, btVector3>>;

/// The last frame leads back to the first.
std::vector<BareFrame> bare_frames(const BareCase& bare, int n, std::uint64_t seed) {
  const bool in_layer = bare.kind == BareCase::refused;
  scenes::Random numbers(seed);
  const auto random = [&](double low, double high) { return numbers.range(low, high); };
  const double side = in_layer ? std::floor(std::sqrt(n)) : std::cbrt(1.5 * n);
  std::vector<std::array<double, 6>> motions;
  for (int i = 0; i < n; ++i)
    motions.push_back({random(0, side), random(0, side), random(0, side), random(-1, 1), random(-1, 1), random(-1, 1)});
  if (in_layer) {
    for (int i = 0; i < movers_among_refused; ++i) motions[static_cast<std::size_t>(i)][2] = side / 2;
    for (int i = movers_among_refused; i < n; ++i)
      motions[static_cast<std::size_t>(i)] = {double(i % int(side)), double(i / int(side)), side / 2, 0, 0, 0};
  }
  constexpr int there = 32;
  std::vector<BareFrame> frames;
  for (int frame = 0; frame < 2 * there; ++frame) {
    const double way = bare.pace * (frame < there ? frame : 2 * there - frame);
    BareFrame& boxes = frames.emplace_back();
    for (const auto& m : motions) {
      const btVector3 at(btScalar(m[0] + way * m[3]), btScalar(m[1] + way * m[4]), btScalar(m[2] + way * m[5]));
      boxes.emplace_back(at, at + btVector3(1, 1, 1));
    }
  }
  return frames;
}

bool share_a_point(const std::pair<btVector3, btVector3>& a, const std::pair<btVector3, btVector3>& b) {
  for (int d = 0; d < 3; ++d)
    if (!(a.first[d] <= b.second[d] && b.first[d] <= a.second[d])) return false;
  return true;
}

class BareWorld {
 public:
  BareWorld(BareCase::Kind kind, const std::string& broadphase, const std::vector<BareFrame>& frames)
      : frames_(frames),
        moving_(kind == BareCase::refused ? movers_among_refused : frames[0].size()),
        objects_(frames[0].size()) {
    const auto eager = kind == BareCase::eager ? bullet::Eager::all : bullet::Eager::ghosts;
    broadphase_ = make_broadphase({broadphase, nullptr, eager}, 200, frames[0].size());
    btOverlappingPairCache& cache = *broadphase_->getOverlappingPairCache();
    if (kind == BareCase::refused) cache.setOverlapFilterCallback(&refuse_layer_);
    for (std::size_t i = 0; i < frames[0].size(); ++i) {
      objects_[i].setUserIndex(static_cast<int>(i));
      proxies_.push_back(broadphase_->createProxy(frames[0][i].first, frames[0][i].second, 0, &objects_[i],
                                                  i < moving_ ? 1 : 2, 1, nullptr));
    }
  }
  ~BareWorld() {
    struct EndAll : btOverlapCallback {
      bool processOverlap(btBroadphasePair&) override { return true; }
    } end_all;
    broadphase_->getOverlappingPairCache()->processAllOverlappingPairs(&end_all, nullptr);
    for (btBroadphaseProxy* proxy : proxies_) broadphase_->destroyProxy(proxy, nullptr);
  }
  BareWorld(const BareWorld&) = delete;
  BareWorld& operator=(const BareWorld&) = delete;

  void advance() {
    now_ = (now_ + 1) % frames_.size();
    const BareFrame& boxes = frames_[now_];
    for (std::size_t i = 0; i < moving_; ++i)
      broadphase_->setAabb(proxies_[i], boxes[i].first, boxes[i].second, nullptr);
    broadphase_->calculateOverlappingPairs(nullptr);
  }

  /// Those held whose boxes overlap.
  PairSummary exact_pairs() const {
    PairSummary summary;
    const btOverlappingPairCache& cache = *broadphase_->getOverlappingPairCache();
    const btBroadphasePair* const held = cache.getOverlappingPairArrayPtr();
    for (int i = 0; i < cache.getNumOverlappingPairs(); ++i) {
      const auto a = index_of(held[i].m_pProxy0), b = index_of(held[i].m_pProxy1);
      if (share_a_point(frames_[now_][a], frames_[now_][b])) summary.add(a, b);
    }
    return summary;
  }

  /// Those there are.
  PairSummary expected_pairs() const {
    PairSummary summary;
    const BareFrame& boxes = frames_[now_];
    for (std::uint32_t a = 0; a < moving_; ++a)
      for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
        if (share_a_point(boxes[a], boxes[b])) summary.add(a, b);
    return summary;
  }

 private:
  static std::uint32_t index_of(const btBroadphaseProxy* proxy) {
    return static_cast<std::uint32_t>(static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex());
  }

  struct RefuseLayer final : btOverlapFilterCallback {
    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
      return (a->m_collisionFilterGroup & b->m_collisionFilterGroup & 2) == 0;
    }
  };

  const std::vector<BareFrame>& frames_;
  const std::size_t moving_;  // how many of the first boxes
  RefuseLayer refuse_layer_;
  std::vector<btCollisionObject> objects_;
  std::unique_ptr<btBroadphaseInterface> broadphase_;
  std::vector<btBroadphaseProxy*> proxies_;
  std::size_t now_ = 0;
};

}  // namespace

void run_bare(const std::string& suite, const BareCase& bare, int n, const Options& options,
              const std::vector<std::string>& peers, Report& report, Progress& progress) {
  progress.show(fmt::format("{} {}, {} boxes", suite, bare.name, n));
  const std::vector<BareFrame> frames = bare_frames(bare, n, options.seed);
  std::vector<std::string> broadphases{"boxstream"};
  for (const std::string& peer : peers)
    if (can_hold(peer, frames[0].size())) broadphases.push_back(peer);
  std::vector<std::unique_ptr<BareWorld>> worlds;
  std::vector<bool> equal;
  for (const std::string& broadphase : broadphases) {
    BareWorld& world = *worlds.emplace_back(std::make_unique<BareWorld>(bare.kind, broadphase, frames));
    bool right = true;
    for (std::size_t frame = 0; frame < 2 * frames.size(); ++frame) {
      world.advance();
      if (frame % 8 == 7) right = right && world.exact_pairs() == world.expected_pairs();
    }
    equal.push_back(right);
  }
  const auto all_frames = [&](BareWorld& world) {
    return [&] {
      for (std::size_t frame = 0; frame < frames.size(); ++frame) world.advance();
    };
  };
  Race race(
      options, report, progress,
      {.suite = suite, .case_name = bare.name, .n = static_cast<std::size_t>(n), .k = worlds[0]->exact_pairs().count});
  race.units = static_cast<double>(frames.size());
  for (std::size_t peer = 1; peer < worlds.size(); ++peer)
    race.add(broadphases[peer], all_frames(*worlds[peer]), [&, peer] { return equal[0] && equal[peer]; });
  race.run(all_frames(*worlds[0]));
}

}  // namespace boxstream::bench
