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
#include <boxstream/detail/ray_slabs.hpp>

#include "broadphase_impl.hpp"
#include "fatal.hpp"
#include "found.hpp"
#include "found_few.hpp"

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

BasicRay<btScalar> ray_of(const btVector3& from, const btBroadphaseRayCallback& callback, const btVector3& extent_min,
                          const btVector3& extent_max) {
  BasicRay<btScalar> ray;
  copy(from, ray.origin);
  copy(callback.m_rayDirectionInverse, ray.inverse_direction);
  copy(extent_min, ray.extent_min);
  copy(extent_max, ray.extent_max);
  // A ray of no length has a NaN direction in release builds of Bullet, and meets nothing. With a negative length
  // Bullet's own still report boxes around the origin.
  ray.length = at_least_zero(callback.m_lambda_max);
  return ray;
}

}  // namespace

void Broadphase::rayTest(const btVector3& rayFrom, const btVector3&, btBroadphaseRayCallback& rayCallback,
                         const btVector3& aabbMin, const btVector3& aabbMax) {
  if (FoundFew::can_look_along_ray(impl_->live)) {
    FoundFew found(impl_->live, impl_->created);
    {
      const boxstream::detail::LazyFloatEnvironment environment;
      const boxstream::detail::RaySlabs<btScalar> ray(ray_of(rayFrom, rayCallback, aabbMin, aabbMax));
      found.look([&](const Proxy& proxy) {
        const auto box = box_in_world(proxy);
        return ray.meets(box) && is_valid(box);
      });
    }
    return found.report(rayCallback);
  }
  const BasicRay<btScalar> ray = ray_of(rayFrom, rayCallback, aabbMin, aabbMax);
  impl_->flush_pending();
  const Impl& impl = *impl_;
  Found found(impl.spare_lists);
  or_fatal([&] {
    impl.world.query_ray(ray, [&](ProxyId id, btScalar, btScalar length) {
      found.add(id);
      return length;
    });
  });
  found.report(rayCallback, [&](ProxyId id) { return live_proxy_of(impl.world, id); });
}

void Broadphase::aabbTest(const btVector3& aabbMin, const btVector3& aabbMax, btBroadphaseAabbCallback& callback) {
  const auto box = box_of(aabbMin, aabbMax);
  if (FoundFew::can_look_at(impl_->live)) {
    FoundFew found(impl_->live, impl_->created);
    {
      const boxstream::detail::LazyFloatEnvironment environment;
      if (is_valid(box))
        found.look([&](const Proxy& proxy) {
          const auto other = box_of(proxy.m_aabbMin, proxy.m_aabbMax);
          return overlaps(box, other) && is_valid(other);
        });
    }
    return found.report(callback);
  }
  impl_->flush_pending();
  const Impl& impl = *impl_;
  Found found(impl.spare_lists);
  or_fatal([&] {
    const boxstream::detail::DefaultFloatEnvironment environment;
    impl.world.query_box(box, [&](ProxyId id) {
      const Proxy& proxy = impl.proxy_of(id);
      if (impl.is_exact_in_world(proxy) || overlaps(box, box_of(proxy.m_aabbMin, proxy.m_aabbMax))) found.add(id);
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
