// SPDX-License-Identifier: MIT
// libccd by itself. It has no distance.
#include <ccd/ccd.h>

#include <cmath>
#include <stdexcept>

#include "narrow_phase/engine.hpp"

namespace boxstream::report::narrow {
namespace {

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const RoundedBox& solid = *static_cast<const RoundedBox*>(object);
  const Eigen::Vector3d d(direction->v[0], direction->v[1], direction->v[2]);
  const Eigen::Vector3d local = solid.rotation.transpose() * d;
  const Eigen::Vector3d corner = (local.array() < 0).select(-solid.half, solid.half);
  Eigen::Vector3d most = solid.centre + solid.rotation * corner;
  if (solid.margin > 0) most += d * (solid.margin / d.norm());
  ccdVec3Set(point, most.x(), most.y(), most.z());
}

void centre(const void* object, ccd_vec3_t* point) {
  const Eigen::Vector3d& at = static_cast<const RoundedBox*>(object)->centre;
  ccdVec3Set(point, at.x(), at.y(), at.z());
}

}  // namespace

Engine make_libccd(const std::string& solver, Query query, const Tuning& tuning, std::span<const Pose> poses) {
  if (solver != "gjk" && solver != "mpr")
    throw std::invalid_argument("libccd has no solver \"" + solver + "\"; there are gjk, mpr");
  if (query == Query::distance) throw std::invalid_argument("libccd has no distance");
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = support;
  ccd.center1 = ccd.center2 = centre;
  if (!std::isnan(tuning.tolerance)) ccd.epa_tolerance = ccd.mpr_tolerance = tuning.tolerance;
  if (tuning.iterations > 0) ccd.max_iterations = static_cast<unsigned long>(tuning.iterations);
  const bool mpr = solver == "mpr";
  return [=](std::size_t pose) {
    const RoundedBox *a = &poses[pose].a, *b = &poses[pose].b;
    if (query == Query::verdict) return (mpr ? ccdMPRIntersect : ccdGJKIntersect)(a, b, &ccd) != 0 ? -1.0 : 1.0;
    ccd_real_t depth = 0;
    ccd_vec3_t direction, place;
    const int code = (mpr ? ccdMPRPenetration : ccdGJKPenetration)(a, b, &ccd, &depth, &direction, &place);
    if (code == -2) throw std::bad_alloc();
    return code == 0 ? -depth : std::nan("");
  };
}

}  // namespace boxstream::report::narrow
