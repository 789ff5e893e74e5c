// SPDX-License-Identifier: MIT
#include "world/state/compare.hpp"

#include <cstring>

#include "base/keys.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "world/state/compare.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The order of numbers as the order of integers, both zeros being zero.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V keys(D d, V bits) {
  using T = hn::TFromD<D>;
  const V sign = hn::ShiftRight<8 * sizeof(T) - 1>(bits);
  return hn::Sub(hn::Xor(hn::And(bits, hn::Set(d, hwy::LimitsMax<T>())), sign), sign);
}

/// Bounds as they lie in memory, whatever box they belong to: three lower ones, three upper ones, and so on.
template <class S>
HWY_ATTR bool compare(const S* HWY_RESTRICT old, const S* HWY_RESTRICT now, std::size_t groups,
                      std::uint64_t* HWY_RESTRICT changed) {
  using T = hwy::MakeSigned<S>;
  const hn::CappedTag<T, 8> d;  // wider ones slow down what runs after them, and first have to be woken
  const hn::Rebind<S, decltype(d)> d_bounds;
  const auto load = [&](const S* from) HWY_ATTR { return hn::BitCast(d, hn::LoadU(d_bounds, from)); };
  const std::size_t lanes = hn::Lanes(d);
  constexpr std::size_t bounds = 6 * compared_group;
  constexpr std::uint64_t lower_bounds = whole_group | whole_group << 1 | whole_group << 2;
  const auto bits_of = [&](hn::Mask<decltype(d)> mask) HWY_ATTR {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    return std::uint64_t{bytes[0]} | std::uint64_t{bytes[1]} << 8;
  };
  // The bound three further on is the upper one to a lower one. For the last of all, these are read from a copy with
  // something behind it.
  HWY_ALIGN S last[16 + 3] = {};
  const std::size_t last_at = groups * bounds - lanes;
  std::memcpy(last, now + last_at, lanes * sizeof(S));

  std::uint64_t inverted = 0;
  auto largest = hn::Zero(d);
  for (std::size_t g = 0; g < groups; ++g) {
    std::uint64_t different = 0;
    for (std::size_t i = 0; i < bounds; i += lanes) {
      const std::size_t at = g * bounds + i;
      const auto here = load(now + at);
      const auto upper = load(at == last_at ? last + 3 : now + at + 3);
      const auto key = keys(d, here);
      different |= bits_of(hn::Ne(key, keys(d, load(old + at)))) << i;
      inverted |= bits_of(hn::Gt(key, keys(d, upper))) << i & lower_bounds;
      largest = hn::Max(largest, hn::And(here, hn::Set(d, hwy::LimitsMax<T>())));
    }
    different |= different >> 1 | different >> 2;
    changed[g] = (different | different >> 3) & whole_group;
  }
  return inverted == 0 && hn::AllFalse(d, hn::Gt(largest, hn::Set(d, static_cast<T>(infinity_key<S>))));
}

HWY_ATTR bool Compare32(const float* old, const float* now, std::size_t groups, std::uint64_t* changed) {
  return compare(old, now, groups, changed);
}

HWY_ATTR bool Compare64(const double* old, const double* now, std::size_t groups, std::uint64_t* changed) {
  return compare(old, now, groups, changed);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(Compare32);
HWY_EXPORT(Compare64);

bool compare_groups(const Aabb* old, const Aabb* now, std::size_t groups, std::uint64_t* changed) {
  return HWY_DYNAMIC_DISPATCH(Compare32)(old->min, now->min, groups, changed);
}

bool compare_groups(const Aabb64* old, const Aabb64* now, std::size_t groups, std::uint64_t* changed) {
  return HWY_DYNAMIC_DISPATCH(Compare64)(old->min, now->min, groups, changed);
}

template <class Box>
static bool have_same_keys(const Box& x, const Box& y) {
  bool same = true;
  for (int d = 0; d < 3; ++d)
    same = same && order_key(x.min[d]) == order_key(y.min[d]) && order_key(x.max[d]) == order_key(y.max[d]);
  return same;
}

bool differ_by_zeros(const Aabb& x, const Aabb& y) {
  return have_same_keys(x, y);
}
bool differ_by_zeros(const Aabb64& x, const Aabb64& y) {
  return have_same_keys(x, y);
}

}  // namespace boxstream::detail
#endif
