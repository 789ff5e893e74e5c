// SPDX-License-Identifier: MIT
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <memory>

#include <boxstream/bullet.hpp>

#include "cliffs/keeper.hpp"
#include "peers/bullet_boxes.hpp"

namespace boxstream::bench {

namespace {

bool touching(const Aabb& a, const Aabb& b) {
  for (int d = 0; d < 3; ++d)
    if (!(a.min[d] <= b.max[d] && b.min[d] <= a.max[d])) return false;
  return true;
}

/// A broad-phase of Bullet or ours.
class BroadphaseKeeper final : public Keeper {
 public:
  explicit BroadphaseKeeper(std::unique_ptr<btBroadphaseInterface> made) : broadphase(std::move(made)) {}
  ~BroadphaseKeeper() override {
    for (btBroadphaseProxy* proxy : proxies_) broadphase->destroyProxy(proxy, nullptr);
  }
  BroadphaseKeeper(const BroadphaseKeeper&) = delete;
  BroadphaseKeeper& operator=(const BroadphaseKeeper&) = delete;

  void fill(Span<const Aabb> boxes) override {
    proxies_.resize(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) add(i, boxes[i]);
  }
  void remove(std::uint32_t i) override { broadphase->destroyProxy(proxies_[i], nullptr); }
  void add(std::uint32_t i, const Aabb& box) override { proxies_[i] = create(i, box); }
  void come(const Aabb& box) override { newcomer_ = create(static_cast<std::uint32_t>(proxies_.size()), box); }
  void leave() override { broadphase->destroyProxy(newcomer_, nullptr); }
  void move(Span<const std::uint32_t> which, Span<const Aabb> boxes) override {
    for (const std::uint32_t i : which)
      broadphase->setAabb(proxies_[i], vector(boxes[i].min), vector(boxes[i].max), nullptr);
  }
  void update() override { broadphase->calculateOverlappingPairs(nullptr); }
  /// Bullet's own holds pairs of fat boxes, too.
  PairSummary pairs(Span<const Aabb>) override {
    PairSummary summary;
    const btOverlappingPairCache& cache = *broadphase->getOverlappingPairCache();
    const btBroadphasePair* const held = cache.getOverlappingPairArrayPtr();
    for (int i = 0; i < cache.getNumOverlappingPairs(); ++i) {
      const btBroadphaseProxy &a = *held[i].m_pProxy0, &b = *held[i].m_pProxy1;
      bool touch = true;
      for (int d = 0; d < 3; ++d) touch = touch && a.m_aabbMin[d] <= b.m_aabbMax[d] && b.m_aabbMin[d] <= a.m_aabbMax[d];
      if (touch) summary.add(index_of(&a), index_of(&b));
    }
    return summary;
  }

  std::unique_ptr<btBroadphaseInterface> broadphase;

 private:
  btBroadphaseProxy* create(std::uint32_t i, const Aabb& box) {
    return broadphase->createProxy(vector(box.min), vector(box.max), 0, reinterpret_cast<void*>(std::uintptr_t{i}), 1,
                                   1, nullptr);
  }

  std::vector<btBroadphaseProxy*> proxies_;
  btBroadphaseProxy* newcomer_ = nullptr;
};

std::unique_ptr<Keeper> make_adapter_keeper() {
  return std::make_unique<BroadphaseKeeper>(std::make_unique<bullet::Broadphase>());
}

std::uint64_t create_all(Keeper& keeper, const CliffScene& scene) {
  keeper.fill(scene.frame(0));
  keeper.update();
  for (const std::uint32_t i : scene.all()) keeper.remove(i);
  static_cast<BroadphaseKeeper&>(keeper).fill({});
  return 0;
}

std::uint64_t ask_box(Keeper& keeper, const CliffScene& scene) {
  struct Count final : btBroadphaseAabbCallback {
    Count(const CliffScene& of, const Aabb& box) : scene(of), asked(box) {}
    bool process(const btBroadphaseProxy* proxy) override {
      found += touching(scene.at(0, index_of(proxy)), asked);
      return true;
    }
    const CliffScene& scene;
    const Aabb& asked;
    std::uint64_t found = 0;
  };
  const Aabb& box = scene.at(1, ++keeper.turn * 7 % scene.size());
  Count count(scene, box);
  static_cast<BroadphaseKeeper&>(keeper).broadphase->aabbTest(vector(box.min), vector(box.max), count);
  return count.found;
}

/// Which boxes a ray hits is up to rounding, so it is not compared.
std::uint64_t ask_ray(Keeper& keeper, const CliffScene& scene) {
  struct Count final : btBroadphaseRayCallback {
    bool process(const btBroadphaseProxy*) override { return ++found > 0; }
    std::uint64_t found = 0;
  };
  const std::size_t turn = ++keeper.turn;
  const btVector3 from = vector(scene.at(0, turn * 7 % scene.size()).min);
  const auto step = [&](std::size_t prime) { return btScalar(turn * prime % 17) - btScalar(8.5); };  // of any sign
  const btVector3 way(step(3), step(5), step(7));
  Count count;
  const btVector3 direction = way.normalized();
  for (int d = 0; d < 3; ++d) {
    count.m_rayDirectionInverse[d] = btScalar(1) / direction[d];
    count.m_signs[d] = direction[d] < 0;
  }
  count.m_lambda_max = way.length();
  static_cast<BroadphaseKeeper&>(keeper).broadphase->rayTest(from, from + way, count);
  return 0;
}

}  // namespace

std::unique_ptr<Keeper> make_dbvt_keeper() {
  return std::make_unique<BroadphaseKeeper>(std::make_unique<btDbvtBroadphase>());
}

std::vector<CliffCall> bullet_calls() {
  std::vector<CliffCall> calls = frame_calls("Bullet", make_adapter_keeper, make_dbvt_keeper);
  const auto add = [&](const char* name, const char* description, auto run, bool has_history = true) {
    calls.push_back({"Bullet", name, description, make_adapter_keeper, make_dbvt_keeper, run, has_history});
  };
  add("create and remove", "all proxies, with an update between", create_all, false);
  add("aabbTest", "one box", ask_box);
  add("rayTest", "one ray of up to fifteen sides", ask_ray);
  return calls;
}

}  // namespace boxstream::bench
