// SPDX-License-Identifier: MIT
//
// Boxes with a tolerance. Compiled once per SIMD target; the best one for the machine is picked at run time.

#include "batch/records/raise_ends.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/tolerance.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/records/raise_ends.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Highway does not convert between floats and doubles for WebAssembly.
#undef IN_VECTORS
#define IN_VECTORS (HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_WASM)

#if IN_VECTORS
/// `raised` of numbers that are finite.
struct Raised {
  using D = hn::CappedTag<float, 16>;
  using DI = hn::RebindToSigned<D>;
  using Half = hn::Half<D>;
  using D64 = hn::Rebind<double, Half>;

  hn::Vec<D64> tolerance;
  hn::Vec<D64> if_above, if_below;  // steps for those that are rounded up or down

  Raised(double by, Faces faces)
      : tolerance(hn::Set(D64(), by)),
        if_above(hn::Set(D64(), faces == Faces::closed ? -1.0 : 0.0)),
        if_below(hn::Set(D64(), faces == Faces::open ? 1.0 : 0.0)) {}

  HWY_INLINE hn::Vec<Half> half(hn::Vec<D64> x, hn::Vec<hn::RebindToSigned<Half>>& step) const {
    const D64 d64;
    const auto sum = hn::Add(x, tolerance), part = hn::Sub(sum, x);
    const auto lost = hn::Add(hn::Sub(x, hn::Sub(sum, part)), hn::Sub(tolerance, part));
    const auto rounded = hn::DemoteTo(Half(), sum);
    const auto over = hn::Sub(hn::PromoteTo(d64, rounded), sum), zero = hn::Zero(d64);
    const auto off = hn::IfThenElse(hn::Eq(over, zero), hn::Neg(lost), over);
    const auto steps =
        hn::Or(hn::IfThenElseZero(hn::Gt(off, zero), if_above), hn::IfThenElseZero(hn::Lt(off, zero), if_below));
    step = hn::DemoteTo(hn::RebindToSigned<Half>(), steps);
    return rounded;
  }

  HWY_INLINE hn::Vec<D> operator()(hn::Vec<D> high) const {
    const D d;
    const DI di;
    hn::Vec<hn::RebindToSigned<Half>> low_steps, high_steps;
    const auto low_half = half(hn::PromoteTo(D64(), hn::LowerHalf(Half(), high)), low_steps);
    const auto high_half = half(hn::PromoteTo(D64(), hn::UpperHalf(Half(), high)), high_steps);
    const auto step = hn::Combine(di, high_steps, low_steps);
    auto bits = hn::BitCast(di, hn::Combine(d, high_half, low_half));
    const auto magnitude = hn::Set(di, INT32_MAX);
    const auto key_of = [&](auto x) { return hn::Xor(x, hn::And(hn::ShiftRight<31>(x), magnitude)); };
    bits = hn::IfThenZeroElse(hn::Eq(bits, hn::Set(di, INT32_MIN)), bits);
    auto key = hn::Add(key_of(bits), step);
    key = hn::Add(key, hn::IfThenElseZero(hn::Eq(key, hn::Set(di, -1)), step));  // it would be another zero
    return hn::BitCast(d, key_of(key));
  }
};
#endif

/// Three vectors are whole boxes, whatever their width: which of their numbers are high ends is always the same.
HWY_ATTR void RaiseEnds(Span<const Aabb> boxes, double tolerance, Faces faces, Aabb* out) {
  const auto one = [&](std::size_t i) {
    out[i] = boxes[i];
    if (is_valid(boxes[i])) raise(out[i], tolerance, faces);
  };
  std::size_t i = 0;
#if IN_VECTORS
  const Raised::D d;
  const std::size_t lanes = hn::Lanes(d), at_once = lanes / 2;
  // Low ends are read three numbers before high ones, hence not of the first box.
  if (tolerance < 0x1p1000 && !boxes.empty()) {
    one(i++);
    const Raised raised(tolerance, faces);
    alignas(64) float is_high[3 * 16];
    for (std::size_t k = 0; k < 3 * lanes; ++k) is_high[k] = k % 6 < 3 ? 0.0f : 1.0f;
    const auto most = hn::Set(d, std::numeric_limits<float>::max());
    for (; i + at_once <= boxes.size(); i += at_once) {
      const float* const from = boxes[i].min;
      float* const to = out[i].min;
      bool all_plain = true;
      for (std::size_t v = 0; v < 3; ++v) {
        const auto high_ends = hn::Ne(hn::Load(d, is_high + v * lanes), hn::Zero(d));
        const auto numbers = hn::LoadU(d, from + v * lanes);
        const auto is_plain =
            hn::And(hn::Le(hn::LoadU(d, from + v * lanes - 3), numbers), hn::Le(hn::Abs(numbers), most));
        all_plain = all_plain && hn::AllTrue(d, hn::Or(hn::Not(high_ends), is_plain));
        hn::StoreU(hn::IfThenElse(high_ends, raised(numbers), numbers), d, to + v * lanes);
      }
      if (!all_plain)
        for (std::size_t k = 0; k < at_once; ++k) one(i + k);
    }
  }
#endif
  for (; i < boxes.size(); ++i) one(i);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(RaiseEnds);

void raise_ends(Span<const Aabb> boxes, double tolerance, Faces faces, Aabb* out) {
  HWY_DYNAMIC_DISPATCH(RaiseEnds)(boxes, tolerance, faces, out);
}

}  // namespace boxstream::detail
#endif
