// SPDX-License-Identifier: MIT
#pragma once

#include <ccd/ccd.h>

#include "shape_pair.hpp"

namespace boxstream::ccd {

/// The answer of libccd, and what its support calls revealed.
struct LibccdAnswer {
  bool hit = false;
  bool limit = false;       ///< stopped at the limit of iterations
  bool degenerate = false;  ///< it passed a zero or NaN direction
  double gap = 0;    ///< largest gap between parallel planes that separate the shapes; negative if none was found
  double depth = 0;  ///< of penetration, by libccd
  Vec direction = Vec::Zero();  ///< unit length, or zero if there is none
};

/// One call of libccd. Its EPA and MPR loop without a bound and free their memory only at their end. So the support
/// functions count, and once the limit is reached they return points and tolerances that end every loop of libccd.
class LibccdCall {
 public:
  enum class Of { shapes, cores };

  LibccdCall(const ShapePair& pair, Of what, int max_iterations, const Vec& first_direction);
  LibccdCall(const LibccdCall&) = delete;
  LibccdCall& operator=(const LibccdCall&) = delete;

  LibccdAnswer gjk();
  LibccdAnswer mpr();
  LibccdAnswer gjk_penetration();
  LibccdAnswer mpr_penetration();

 private:
  struct Side {
    LibccdCall* call;
    const PlacedShape* shape;
  };

  static void support_a(const void* side, const ccd_vec3_t* direction, ccd_vec3_t* point);
  static void support_b(const void* side, const ccd_vec3_t* direction, ccd_vec3_t* point);
  static void centre(const void* side, ccd_vec3_t* point);
  static void first_direction(const void* side, const void*, ccd_vec3_t* direction);

  Vec support(const PlacedShape& shape, const ccd_vec3_t* direction);
  void end();
  LibccdAnswer finish(bool hit);
  LibccdAnswer finish_penetration(int code, ccd_real_t depth, const ccd_vec3_t& direction);

  Of what_;
  int points_left_;
  bool ended_ = false;
  Vec first_;
  Vec on_a_ = Vec::Zero();
  LibccdAnswer answer_;
  ccd_t ccd_;
  Side a_;
  Side b_;
};

}  // namespace boxstream::ccd
