// SPDX-License-Identifier: MIT
#pragma once

#include <ccd/ccd.h>

#include "couple.hpp"

namespace boxstream::ccd {

/// What libccd said, and what was seen while it was at work.
struct LibccdAnswer {
  bool hit = false;
  bool limit = false;       ///< it was made to stop
  bool degenerate = false;  ///< it asked for a direction that is none
  double gap = 0;    ///< largest distance between two parallel planes that were seen to part the shapes; or negative
  double depth = 0;  ///< of penetration, as libccd has it
  Vec direction = Vec::Zero();  ///< unit length, or zero if libccd had none
};

/// One question to libccd. EPA and MPR loop without a bound, and only they know how to end and free their memory; so
/// the support functions, which are ours, count, and when the budget is spent they hand out points and tolerances at
/// which every loop of libccd ends.
class LibccdCall {
 public:
  enum class Of { shapes, cores };

  LibccdCall(const Couple& couple, Of what, int max_iterations, const Vec& first_direction);
  LibccdCall(const LibccdCall&) = delete;
  LibccdCall& operator=(const LibccdCall&) = delete;

  LibccdAnswer gjk();
  LibccdAnswer mpr();
  LibccdAnswer gjk_penetration();
  LibccdAnswer mpr_penetration();

 private:
  struct Side {
    LibccdCall* call;
    const Posed* shape;
  };

  static void support_a(const void* side, const ccd_vec3_t* direction, ccd_vec3_t* point);
  static void support_b(const void* side, const ccd_vec3_t* direction, ccd_vec3_t* point);
  static void centre(const void* side, ccd_vec3_t* point);
  static void first_direction(const void* side, const void*, ccd_vec3_t* direction);

  Vec support(const Posed& shape, const ccd_vec3_t* direction);
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
