// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>

#include <boxstream/near.hpp>
#include <boxstream/world.hpp>

#include "status.hpp"

// What C gives, as what the library takes: the same bytes.
namespace boxstream::c {

static_assert(sizeof(Aabb) == 6 * sizeof(float) && sizeof(Aabb64) == 6 * sizeof(double));
static_assert(sizeof(Ball) == 4 * sizeof(float) && sizeof(Ball64) == 4 * sizeof(double));
static_assert(sizeof(boxstream_pair) == sizeof(Pair) && sizeof(boxstream_filter) == sizeof(Filter));
static_assert(sizeof(boxstream_id) == sizeof(ProxyId) && sizeof(boxstream_id_pair) == sizeof(ProxyPair));

template <class To, class From>
Span<const To> view(const From* data, std::size_t count, const char* what) {
  if (count > 0) need(data, what);
  return {reinterpret_cast<const To*>(data), count};
}

template <class S>
Span<const BasicAabb<S>> boxes_of(const boxstream_boxes& boxes) {
  return view<BasicAabb<S>>(static_cast<const S*>(boxes.data), boxes.count, "no boxes");
}

inline Span<const Filter> filters_of(const boxstream_boxes& boxes) {
  if (boxes.filters == nullptr) return {};
  return view<Filter>(boxes.filters, boxes.count, "no filters");
}

constexpr const char* no_scalar = "a scalar is BOXSTREAM_FLOAT or BOXSTREAM_DOUBLE";

/// Calls `work(S{})` with the type of a scalar.
template <class Work>
void with_scalar(boxstream_scalar scalar, Work work) {
  if (scalar == BOXSTREAM_FLOAT)
    work(float{});
  else if (scalar == BOXSTREAM_DOUBLE)
    work(double{});
  else
    throw std::invalid_argument(no_scalar);
}

/// Writes as much of a struct as its user knows of.
template <class Struct>
void give(Struct* out, Struct value) {
  if (out == nullptr) return;
  if (out->size < sizeof(std::size_t)) throw std::invalid_argument("a struct needs its size");
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
