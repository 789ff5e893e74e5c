// SPDX-License-Identifier: MIT
#include "libccd.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "library_precision.hpp"

namespace boxstream::ccd {
namespace {

Vec from(const ccd_vec3_t& v) {
  return {static_cast<double>(v.v[0]), static_cast<double>(v.v[1]), static_cast<double>(v.v[2])};
}

void put(const Vec& v, ccd_vec3_t* out) {
  ccdVec3Set(out, static_cast<ccd_real_t>(v.x()), static_cast<ccd_real_t>(v.y()), static_cast<ccd_real_t>(v.z()));
}

void check_library() {
  static const bool same = library_has_our_reals();
  if (!same)
    throw std::runtime_error(
        "boxstream: the libccd that is linked has another precision than the headers it was compiled with");
}

}  // namespace

std::size_t real_size() {
  return sizeof(ccd_real_t);
}

LibccdCall::LibccdCall(const ShapePair& pair, Of what, int max_iterations, const Vec& first_direction)
    : what_(what), points_left_(max_iterations), first_(first_direction), a_{this, &pair.a}, b_{this, &pair.b} {
  check_library();
  answer_.gap = -std::numeric_limits<double>::infinity();
  CCD_INIT(&ccd_);
  ccd_.support1 = support_a;
  ccd_.support2 = support_b;
  ccd_.center1 = centre;
  ccd_.center2 = centre;
  ccd_.first_dir = LibccdCall::first_direction;
  ccd_.max_iterations = static_cast<unsigned long>(max_iterations);
  ccd_.mpr_tolerance = static_cast<ccd_real_t>(pair.tolerance / 4);
  // EPA compares it with squares of lengths, and ends at the first of two criteria.
  ccd_.epa_tolerance = static_cast<ccd_real_t>(0.01 * pair.tolerance * pair.tolerance);
}

void LibccdCall::end() {
  ended_ = true;
  ccd_.max_iterations = 0;
  ccd_.mpr_tolerance = ccd_.epa_tolerance = std::numeric_limits<ccd_real_t>::infinity();
}

Vec LibccdCall::support(const PlacedShape& shape, const ccd_vec3_t* direction) {
  const Vec d = from(*direction);
  const double length2 = d.squaredNorm();
  if (!ended_ && !(length2 > 0 && std::isfinite(length2))) answer_.degenerate = true, end();
  // The same point for both shapes is the origin of A - B: neither beyond any face nor before it.
  if (ended_) return Vec::Zero();
  return what_ == Of::cores ? shape.core_support(d) : shape.support(d);
}

void LibccdCall::support_a(const void* side, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const Side& me = *static_cast<const Side*>(side);
  LibccdCall& call = *me.call;
  if (!call.ended_ && call.points_left_-- <= 0) call.answer_.limit = true, call.end();
  call.on_a_ = call.support(*me.shape, direction);
  put(call.on_a_, point);
}

void LibccdCall::support_b(const void* side, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const Side& me = *static_cast<const Side*>(side);
  LibccdCall& call = *me.call;
  const bool whole = !call.ended_;
  const Vec on_b = call.support(*me.shape, direction);
  put(on_b, point);
  // libccd asks for A along d and then for B along -d: the gap along d is between these two points.
  if (whole && !call.ended_) {
    const Vec d = -from(*direction);
    call.answer_.gap = std::max(call.answer_.gap, d.dot(on_b - call.on_a_) / d.norm());
  }
}

void LibccdCall::centre(const void* side, ccd_vec3_t* point) {
  put(static_cast<const Side*>(side)->shape->inside(), point);
}

void LibccdCall::first_direction(const void* side, const void*, ccd_vec3_t* direction) {
  put(static_cast<const Side*>(side)->call->first_, direction);
}

LibccdAnswer LibccdCall::finish(bool hit) {
  answer_.hit = hit;
  return answer_;
}

LibccdAnswer LibccdCall::finish_penetration(int code, ccd_real_t depth, const ccd_vec3_t& direction) {
  if (code == -2) throw std::bad_alloc();
  answer_.hit = code == 0;
  const Vec d = from(direction);
  const double length = d.norm();
  if (answer_.hit && std::isfinite(depth) && std::abs(length - 1) < 1e-3) {
    answer_.depth = static_cast<double>(depth);
    answer_.direction = d / length;
  }
  return answer_;
}

LibccdAnswer LibccdCall::gjk() {
  return finish(ccdGJKIntersect(&a_, &b_, &ccd_) != 0);
}

LibccdAnswer LibccdCall::mpr() {
  return finish(ccdMPRIntersect(&a_, &b_, &ccd_) != 0);
}

LibccdAnswer LibccdCall::gjk_penetration() {
  ccd_real_t depth = 0;
  ccd_vec3_t direction{}, position{};
  const int code = ccdGJKPenetration(&a_, &b_, &ccd_, &depth, &direction, &position);
  return finish_penetration(code, depth, direction);
}

LibccdAnswer LibccdCall::mpr_penetration() {
  ccd_real_t depth = 0;
  ccd_vec3_t direction{}, position{};
  const int code = ccdMPRPenetration(&a_, &b_, &ccd_, &depth, &direction, &position);
  return finish_penetration(code, depth, direction);
}

}  // namespace boxstream::ccd
