// SPDX-License-Identifier: MIT
#include "formats/record/player.hpp"

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "formats/record/forwarding_broadphase.hpp"

namespace boxstream::record {
namespace {

btVector3 vector(const double (&v)[3]) {
  return btVector3(static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2]));
}

/// Never null, which btSimpleBroadphase takes for a proxy that is gone.
void* client_of(std::uint32_t id) {
  return reinterpret_cast<void*>(std::uintptr_t{id} + 1);
}
std::uint32_t id_of(const btBroadphaseProxy& proxy) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(proxy.m_clientObject) - 1);
}

struct CollectHits final : btBroadphaseAabbCallback {
  bool process(const btBroadphaseProxy* proxy) override {
    ids.push_back(id_of(*proxy));
    return true;
  }
  std::vector<std::uint32_t> ids;
};

struct IgnoreHits final : btBroadphaseRayCallback {
  bool process(const btBroadphaseProxy*) override { return true; }
};

}  // namespace

Player::Player(std::string name, std::unique_ptr<btBroadphaseInterface> broadphase, std::uint64_t most_pairs)
    : name_(std::move(name)), broadphase_(std::move(broadphase)), most_pairs_(most_pairs) {}

Player::~Player() {
  // Bullet's broad-phases leave proxies behind, and scan all pairs for each proxy that is destroyed: so pairs first.
  scenes::EndAllPairs end_all;
  broadphase_->getOverlappingPairCache()->processAllOverlappingPairs(&end_all, nullptr);
  for (btBroadphaseProxy* const proxy : proxies_)
    if (proxy != nullptr) broadphase_->destroyProxy(proxy, nullptr);
}

void Player::apply(const Op& op) {
  std::visit([this](const auto& each) { call(each); }, op);
  check_pairs(static_cast<std::uint64_t>(broadphase_->getOverlappingPairCache()->getNumOverlappingPairs()),
              most_pairs_);
}

void Player::call(const Create& op) {
  btBroadphaseProxy* const proxy = broadphase_->createProxy(vector(op.box.min), vector(op.box.max), op.shape,
                                                            client_of(op.id), op.group, op.mask, nullptr);
  if (proxy == nullptr) throw RecordError(fmt::format("{} has no room for proxy {}", name_, op.id));
  proxies_.push_back(proxy);
}

void Player::call(const Move& op) {
  broadphase_->setAabb(proxies_[op.id], vector(op.box.min), vector(op.box.max), nullptr);
}

void Player::call(const Destroy& op) {
  broadphase_->destroyProxy(std::exchange(proxies_[op.id], nullptr), nullptr);
}

void Player::call(const Refilter& op) {
  proxies_[op.id]->m_collisionFilterGroup = op.group;
  proxies_[op.id]->m_collisionFilterMask = op.mask;
}

void Player::call(const BoxQuery& op) {
  CollectHits hits;
  broadphase_->aabbTest(vector(op.box.min), vector(op.box.max), hits);
  std::sort(hits.ids.begin(), hits.ids.end());
  hits_.push_back(std::move(hits.ids));
}

void Player::call(const RayQuery& op) {
  IgnoreHits callback;
  callback.m_rayDirectionInverse = vector(op.inverse_direction);
  for (int d = 0; d < 3; ++d) callback.m_signs[d] = callback.m_rayDirectionInverse[d] < 0;
  callback.m_lambda_max = static_cast<btScalar>(op.length);
  broadphase_->rayTest(vector(op.from), vector(op.to), callback, vector(op.extent_min), vector(op.extent_max));
}

void Player::call(const Batch&) {
  broadphase_->calculateOverlappingPairs(nullptr);
}

void Player::call(const ResetPool&) {
  broadphase_->resetPool(nullptr);
}

std::vector<Pair> Player::held() const {
  const btOverlappingPairCache& cache = *broadphase_->getOverlappingPairCache();
  const int count = cache.getNumOverlappingPairs();
  const btBroadphasePair* const pairs = count > 0 ? cache.getOverlappingPairArrayPtr() : nullptr;
  std::vector<Pair> held;
  held.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const std::uint32_t a = id_of(*pairs[i].m_pProxy0), b = id_of(*pairs[i].m_pProxy1);
    held.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(held.begin(), held.end());
  return held;
}

std::vector<std::vector<std::uint32_t>> Player::take_hits() {
  return std::exchange(hits_, {});
}

}  // namespace boxstream::record
