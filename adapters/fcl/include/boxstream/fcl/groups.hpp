// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstdint>

#include <boxstream/detector.hpp>

namespace boxstream::fcl {

/// Group and mask bits of one object. Two objects may pair when each one's group meets the other's mask:
/// (a.group & b.mask) != 0 and (b.group & a.mask) != 0.
struct Groups {
  std::uint16_t group = 1;
  std::uint16_t mask = 0xffff;
};

namespace detail {

/// The core's filter bits for an object. Groups of moving objects are in the lower half, those of static ones in the
/// upper; masks of moving objects cover both halves, those of static ones the lower. So two static objects never pair,
/// and all other pairs follow the bits of `groups`. A moving object with groups {} has the core's default, Filter{}.
constexpr Filter filter_of(Groups groups, bool is_static) {
  const std::uint32_t group = groups.group;
  const std::uint32_t mask = groups.mask;
  return is_static ? Filter{group << 16, mask} : Filter{group, mask | mask << 16};
}

/// The inverse of `filter_of`.
constexpr Groups groups_of(Filter filter, bool is_static) {
  return {static_cast<std::uint16_t>(is_static ? filter.group >> 16 : filter.group),
          static_cast<std::uint16_t>(filter.mask)};
}

/// For the object of a query, which pairs with static and moving objects.
constexpr Filter as_moving(Filter filter, bool is_static) {
  return is_static ? filter_of(groups_of(filter, true), false) : filter;
}

}  // namespace detail

}  // namespace boxstream::fcl
