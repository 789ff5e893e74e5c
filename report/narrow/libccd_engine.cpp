// SPDX-License-Identifier: MIT
// libccd by itself. It has no distance.
#include <ccd/ccd.h>

#include <cmath>
#include <stdexcept>

#include "engine.hpp"

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

class Libccd : public Engine {
 public:
  Libccd(bool mpr, Query query, const Tuning& tuning, std::span<const Pose> poses)
      : mpr_(mpr), query_(query), poses_(poses) {
    CCD_INIT(&ccd_);
    ccd_.support1 = ccd_.support2 = support;
    ccd_.center1 = ccd_.center2 = centre;
    if (!std::isnan(tuning.tolerance)) ccd_.epa_tolerance = ccd_.mpr_tolerance = tuning.tolerance;
    if (tuning.iterations > 0) ccd_.max_iterations = static_cast<unsigned long>(tuning.iterations);
  }

  double ask(std::size_t pose) override {
    const RoundedBox *a = &poses_[pose].a, *b = &poses_[pose].b;
    if (query_ == Query::verdict) return (mpr_ ? ccdMPRIntersect : ccdGJKIntersect)(a, b, &ccd_) != 0 ? -1 : 1;
    ccd_real_t depth = 0;
    ccd_vec3_t direction, place;
    const int code = (mpr_ ? ccdMPRPenetration : ccdGJKPenetration)(a, b, &ccd_, &depth, &direction, &place);
    if (code == -2) throw std::bad_alloc();
    return code == 0 ? -depth : std::nan("");
  }

 private:
  bool mpr_;
  Query query_;
  std::span<const Pose> poses_;
  ccd_t ccd_;
};

}  // namespace

std::unique_ptr<Engine> make_libccd(const std::string& solver, Query query, const Tuning& tuning,
                                    std::span<const Pose> poses) {
  if (solver != "gjk" && solver != "mpr")
    throw std::invalid_argument("libccd has no solver \"" + solver + "\"; there are gjk, mpr");
  if (query == Query::distance) throw std::invalid_argument("libccd has no distance");
  return std::make_unique<Libccd>(solver == "mpr", query, tuning, poses);
}

}  // namespace boxstream::report::narrow
