// SPDX-License-Identifier: MIT
#pragma once

#include <ccd/ccd.h>

#include <cmath>

namespace boxstream::ccd {

/// True if the libccd that is linked has the real numbers of the headers that this was compiled with. It calls a
/// function of the library whose answer is known; arguments of the other width would be read as other numbers.
inline bool library_has_our_reals() {
  ccd_vec3_t point, from, to;
  ccdVec3Set(&point, ccd_real_t(0.25), 3, 0);
  ccdVec3Set(&from, 0, 0, 0);
  ccdVec3Set(&to, 1, 0, 0);
  ccd_vec3_t room[4] = {point, point, point, point};  // a wider answer than ours must find space
  const ccd_real_t distance2 = ccdVec3PointSegmentDist2(&room[0], &from, &to, &room[2]);
  return std::fabs(distance2 - 9) < ccd_real_t(1e-3) && std::fabs(room[2].v[0] - ccd_real_t(0.25)) < ccd_real_t(1e-3);
}

}  // namespace boxstream::ccd
