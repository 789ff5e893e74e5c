// SPDX-License-Identifier: MIT
// Stands before Highway's own header, and adds what Highway 1.0.3 lacks for WebAssembly alone of what the library uses:
// arithmetic and comparisons of doubles, and shifts of 64-bit lanes to the right, each by its own number of bits.
#pragma once

#include_next <hwy/highway.h>

namespace hwy::HWY_NAMESPACE {

template <size_t N, HWY_IF_LE128(double, N)>
HWY_API Vec128<double, N> Set(Simd<double, N, 0>, double x) {
  return Vec128<double, N>{wasm_f64x2_splat(x)};
}
template <size_t N>
HWY_API Vec128<double, N> operator+(Vec128<double, N> a, Vec128<double, N> b) {
  return Vec128<double, N>{wasm_f64x2_add(a.raw, b.raw)};
}
template <size_t N>
HWY_API Vec128<double, N> operator-(Vec128<double, N> a, Vec128<double, N> b) {
  return Vec128<double, N>{wasm_f64x2_sub(a.raw, b.raw)};
}
template <size_t N>
HWY_API Vec128<double, N> operator*(Vec128<double, N> a, Vec128<double, N> b) {
  return Vec128<double, N>{wasm_f64x2_mul(a.raw, b.raw)};
}
template <size_t N>
HWY_API Mask128<double, N> operator==(Vec128<double, N> a, Vec128<double, N> b) {
  return Mask128<double, N>{wasm_f64x2_eq(a.raw, b.raw)};
}
template <size_t N>
HWY_API Mask128<double, N> operator<=(Vec128<double, N> a, Vec128<double, N> b) {
  return Mask128<double, N>{wasm_f64x2_le(a.raw, b.raw)};
}
template <size_t N>
HWY_API Mask128<double, N> operator>(Vec128<double, N> a, Vec128<double, N> b) {
  return Mask128<double, N>{wasm_f64x2_gt(a.raw, b.raw)};
}

template <size_t N>
HWY_API Vec128<uint64_t, N> operator>>(Vec128<uint64_t, N> v, Vec128<uint64_t, N> bits) {
  return Vec128<uint64_t, N>{
      wasm_u64x2_make(wasm_u64x2_extract_lane(v.raw, 0) >> wasm_u64x2_extract_lane(bits.raw, 0),
                      wasm_u64x2_extract_lane(v.raw, 1) >> wasm_u64x2_extract_lane(bits.raw, 1))};
}

}  // namespace hwy::HWY_NAMESPACE
