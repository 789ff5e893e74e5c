// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include <boxstream/detail/float_environment.hpp>
#include <boxstream/detail/lazy_float_environment.hpp>

#include "broadphase_impl.hpp"
#include "fatal.hpp"
#include "found.hpp"
#include "found_few.hpp"
#include "lanes.hpp"
#include "plain_ray.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

/// Zero for a negative number, and what it is otherwise. By bits, for the floating-point environment may be any.
btScalar at_least_zero(btScalar length) {
  using Bits = std::conditional_t<sizeof(btScalar) == 4, std::uint32_t, std::uint64_t>;
  constexpr auto minus_infinity = std::bit_cast<Bits>(-std::numeric_limits<btScalar>::infinity());
  constexpr Bits sign = Bits(1) << (8 * sizeof(Bits) - 1);
  const auto bits = std::bit_cast<Bits>(length);
  return bits >= sign && bits <= minus_infinity ? btScalar(0) : length;
}

void copy(const btVector3& from, btScalar (&to)[3]) {
  to[0] = from.x();
  to[1] = from.y();
  to[2] = from.z();
}

/// False for a ray that only the World can follow.
bool look_along(const btVector3& from, const btVector3& inverse, btScalar length, const btVector3& extent_min,
                const btVector3& extent_max, FoundFew& found) {
  const boxstream::detail::LazyFloatEnvironment environment;
  const PlainRay ray(from, inverse, length, extent_min, extent_max);
  if (!ray.is_plain()) return false;
  found.look([&](const Proxy& proxy) {
    if (proxy.margin == 0)
      return ray.meets({proxy.m_aabbMin, proxy.m_aabbMax}) && is_valid(box_of(proxy.m_aabbMin, proxy.m_aabbMax));
    const auto box = box_in_world(proxy);
    const btVector3 min(box.min[0], box.min[1], box.min[2]), max(box.max[0], box.max[1], box.max[2]);
    return ray.meets({min, max}) && is_valid(box);
  });
  return true;
}

void look_at(const BasicAabb<btScalar>& box, FoundFew& found) {
  const boxstream::detail::LazyFloatEnvironment environment;
  if (!is_valid(box)) return;
  const Lanes min{box.min[0], box.min[1], box.min[2]}, max{box.max[0], box.max[1], box.max[2]};
  found.look([&](const Proxy& proxy) {
    const BoxLanes other(proxy.m_aabbMin, proxy.m_aabbMax);
    return !has_any_of_three((other.min > max) | (min > other.max)) &&
           is_valid(box_of(proxy.m_aabbMin, proxy.m_aabbMax));
  });
}

}  // namespace

void Broadphase::rayTest(const btVector3& rayFrom, const btVector3&, btBroadphaseRayCallback& rayCallback,
                         const btVector3& aabbMin, const btVector3& aabbMax) {
  // A ray of no length has a NaN direction in release builds of Bullet, and meets nothing. With a negative length
  // Bullet's own still report boxes around the origin.
  const btScalar length = at_least_zero(rayCallback.m_lambda_max);
  if (FoundFew::can_look(impl_->live)) {
    FoundFew found(impl_->live, impl_->created);
    if (look_along(rayFrom, rayCallback.m_rayDirectionInverse, length, aabbMin, aabbMax, found))
      return found.report(rayCallback);
  }
  BasicRay<btScalar> ray;
  copy(rayFrom, ray.origin);
  copy(rayCallback.m_rayDirectionInverse, ray.inverse_direction);
  copy(aabbMin, ray.extent_min);
  copy(aabbMax, ray.extent_max);
  ray.length = length;
  impl_->flush_pending();
  const Impl& impl = *impl_;
  Found found(impl.spare_lists);
  or_fatal([&] {
    impl.world.query_ray(ray, [&](ProxyId id, btScalar, btScalar to) {
      found.add(id);
      return to;
    });
  });
  found.report(rayCallback, [&](ProxyId id) { return live_proxy_of(impl.world, id); });
}

void Broadphase::aabbTest(const btVector3& aabbMin, const btVector3& aabbMax, btBroadphaseAabbCallback& callback) {
  const auto box = box_of(aabbMin, aabbMax);
  if (FoundFew::can_look(impl_->live)) {
    FoundFew found(impl_->live, impl_->created);
    look_at(box, found);
    return found.report(callback);
  }
  impl_->flush_pending();
  const Impl& impl = *impl_;
  Found found(impl.spare_lists);
  const auto meets = [&](const Proxy& proxy) {
    if (impl.is_exact_in_world(proxy)) return true;
    const boxstream::detail::DefaultFloatEnvironment environment;
    return overlaps(box, box_of(proxy.m_aabbMin, proxy.m_aabbMax));
  };
  or_fatal([&] {
    impl.world.query_box(box, [&](ProxyId id) {
      if (meets(impl.proxy_of(id))) found.add(id);
      return true;
    });
  });
  found.report(callback, [&](ProxyId id) { return live_proxy_of(impl.world, id); });
}

void Broadphase::planesTest(const btVector3* normals, const btScalar* offsets, int count,
                            btBroadphaseAabbCallback& callback) const {
  impl_->flush_pending();
  const Impl& impl = *impl_;
  using Plane = BasicPlane<btScalar>;
  Found found(impl.spare_lists);
  or_fatal([&] {
    constexpr std::size_t few = 16;
    const std::size_t wanted = count > 0 ? std::size_t(count) : 0;
    Plane on_stack[few];
    std::vector<Plane> on_heap(wanted > few ? wanted : 0);
    const Span<Plane> planes(wanted > few ? on_heap.data() : on_stack, wanted);
    for (std::size_t i = 0; i < wanted; ++i) {
      copy(normals[i], planes[i].normal);
      planes[i].offset = offsets[i];
    }
    impl.world.query_planes(Span<const Plane>(planes), [&](ProxyId id) {
      const Proxy& proxy = impl.proxy_of(id);
      const auto rejects = [&](const Plane& plane) {
        return is_behind(box_of(proxy.m_aabbMin, proxy.m_aabbMax), plane);
      };
      if (impl.is_exact_in_world(proxy) || std::none_of(planes.begin(), planes.end(), rejects)) found.add(id);
      return true;
    });
  });
  found.report(callback, [&](ProxyId id) { return live_proxy_of(impl.world, id); });
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
