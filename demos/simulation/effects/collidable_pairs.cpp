// SPDX-License-Identifier: MIT
#include "simulation/effects/collidable_pairs.hpp"

#include <algorithm>
#include <map>

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>

namespace boxstream::effects {

CollidablePairs::CollidablePairs(const scenes::Expanded& expanded) : bodies_(expanded.bodies) {
  std::map<Class, std::uint32_t> known;
  class_of_body_.reserve(bodies_.size());
  for (const scenes::Body& body : bodies_) {
    const Class own = class_of(body.traits);
    const auto [at, is_new] = known.try_emplace(own, static_cast<std::uint32_t>(classes_.size()));
    if (is_new) classes_.push_back(own);
    class_of_body_.push_back(at->second);
  }
  const auto exclude = [this](std::size_t a, std::size_t b) {
    if (a == b) return;
    excluded_.push_back({a, b});
    excluded_.push_back({b, a});
  };
  for (const auto& [a, b] : expanded.exclusions) exclude(a, b);
  for (const scenes::Joint& joint : expanded.joints)
    if (joint.b && !joint.collide) exclude(joint.a, *joint.b);
  std::sort(excluded_.begin(), excluded_.end());
  excluded_.erase(std::unique(excluded_.begin(), excluded_.end()), excluded_.end());
}

CollidablePairs::Class CollidablePairs::class_of(const scenes::BodyTraits& traits) {
  const bool dynamic = traits.type == scenes::BodyType::dynamic;
  if (traits.group || traits.mask)
    return {traits.group.value_or(btBroadphaseProxy::DefaultFilter), traits.mask.value_or(0x7fffffff), dynamic};
  const auto group = dynamic ? btBroadphaseProxy::DefaultFilter : btBroadphaseProxy::StaticFilter;
  const int mask =
      dynamic ? btBroadphaseProxy::AllFilter : btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter;
  return {static_cast<std::uint32_t>(group), static_cast<std::uint32_t>(mask), dynamic};
}

std::vector<std::array<std::size_t, 2>>::const_iterator CollidablePairs::excluded_of(std::size_t body) const {
  return std::lower_bound(excluded_.begin(), excluded_.end(), std::array<std::size_t, 2>{body, 0});
}

}  // namespace boxstream::effects
