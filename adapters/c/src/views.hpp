// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>

#include <boxstream/near.hpp>
#include <boxstream/world.hpp>

#include "status.hpp"

// What C gives, as what the library takes: the same bytes.
namespace boxstream::c {

static_assert(sizeof(Aabb) == 6 * sizeof(float) && sizeof(Aabb64) == 6 * sizeof(double));
static_assert(sizeof(Ball) == 4 * sizeof(float) && sizeof(Ball64) == 4 * sizeof(double));
static_assert(sizeof(boxstream_pair) == sizeof(Pair) && sizeof(boxstream_filter) == sizeof(Filter));
static_assert(sizeof(boxstream_id) == sizeof(ProxyId) && sizeof(boxstream_id_pair) == sizeof(ProxyPair));

/// A count that is -1 of a signed number, and data that do not lie as the processor needs them, are refused.
template <class To, class From>
Span<To> view(From* data, std::size_t count, const char* what) {
  if (count > 0 && data == nullptr) throw std::invalid_argument(what);
  if (count > PTRDIFF_MAX / sizeof(To)) throw std::length_error("a count beyond what memory holds");
  if (reinterpret_cast<std::uintptr_t>(data) % alignof(To) != 0)
    throw std::invalid_argument("data that are not aligned as their type");
  return {reinterpret_cast<To*>(data), count};
}

constexpr const char* no_scalar = "a scalar is BOXSTREAM_FLOAT or BOXSTREAM_DOUBLE";

template <class S>
constexpr boxstream_scalar scalar_of = sizeof(S) == sizeof(float) ? BOXSTREAM_FLOAT : BOXSTREAM_DOUBLE;

inline void check_scalar(boxstream_scalar scalar) {
  if (scalar != BOXSTREAM_FLOAT && scalar != BOXSTREAM_DOUBLE) throw std::invalid_argument(no_scalar);
}

inline Method method_of(boxstream_method method) {
  if (method != BOXSTREAM_PLANNED && method != BOXSTREAM_HYBRID)
    throw std::invalid_argument("a method is BOXSTREAM_PLANNED or BOXSTREAM_HYBRID");
  return method == BOXSTREAM_PLANNED ? Method::planned : Method::hybrid;
}

template <class S>
Span<const BasicAabb<S>> boxes_of(const boxstream_boxes& boxes) {
  check_scalar(boxes.scalar);
  if (boxes.scalar != scalar_of<S>) throw std::invalid_argument("boxes of another scalar");
  return view<const BasicAabb<S>>(static_cast<const S*>(boxes.data), boxes.count, "no boxes");
}

inline Span<const Filter> filters_of(const boxstream_boxes& boxes) {
  if (boxes.filters == nullptr) return {};
  return view<const Filter>(boxes.filters, boxes.count, "no filters");
}

/// Calls `work(S{})` with the type of a scalar.
template <class Work>
void with_scalar(boxstream_scalar scalar, Work work) {
  check_scalar(scalar);
  scalar == BOXSTREAM_FLOAT ? work(float{}) : work(double{});
}

/// Of a struct to be filled, or null: before anything happens.
template <class Struct>
void check_size(const Struct* out) {
  if (out != nullptr && out->size < sizeof(std::size_t)) throw std::invalid_argument("a struct needs its size");
}

/// Writes as much of a struct as its user knows of.
template <class Struct>
void give(Struct* out, Struct value) {
  if (out == nullptr) return;
  value.size = out->size;
  std::memcpy(out, &value, value.size < sizeof value ? value.size : sizeof value);
}

inline boxstream_id to_c(ProxyId id) {
  return {id.slot, id.generation};
}
inline ProxyId from_c(boxstream_id id) {
  return {id.slot, id.generation};
}
inline const boxstream_id_pair* to_c(Span<const ProxyPair> pairs) {
  return reinterpret_cast<const boxstream_id_pair*>(pairs.data());
}

}  // namespace boxstream::c
