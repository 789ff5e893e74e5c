// SPDX-License-Identifier: MIT
#include "same_op.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace boxstream::record_test {

using namespace record;

namespace {

template <std::size_t N>
bool same(const double (&a)[N], const double (&b)[N]) {
  return std::equal(a, a + N, b, [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}
bool same(const Aabb64& a, const Aabb64& b) {
  return same(a.min, b.min) && same(a.max, b.max);
}

struct Same {
  bool operator()(const Create& a, const Create& b) const {
    return a.id == b.id && a.shape == b.shape && a.group == b.group && a.mask == b.mask && same(a.box, b.box);
  }
  bool operator()(const Move& a, const Move& b) const { return a.id == b.id && same(a.box, b.box); }
  bool operator()(const Destroy& a, const Destroy& b) const { return a.id == b.id; }
  bool operator()(const Refilter& a, const Refilter& b) const {
    return a.id == b.id && a.group == b.group && a.mask == b.mask;
  }
  bool operator()(const BoxQuery& a, const BoxQuery& b) const { return same(a.box, b.box); }
  bool operator()(const RayQuery& a, const RayQuery& b) const {
    const double length_a[1]{a.length}, length_b[1]{b.length};
    return same(a.from, b.from) && same(a.to, b.to) && same(a.inverse_direction, b.inverse_direction) &&
           same(length_a, length_b) && same(a.extent_min, b.extent_min) && same(a.extent_max, b.extent_max);
  }
  bool operator()(const Batch& a, const Batch& b) const { return a.pairs == b.pairs; }
  bool operator()(const ResetPool&, const ResetPool&) const { return true; }
  template <class A, class B>
  bool operator()(const A&, const B&) const {
    return false;
  }
};

}  // namespace

bool same(const Op& a, const Op& b) {
  return std::visit(Same{}, a, b);
}

}  // namespace boxstream::record_test
