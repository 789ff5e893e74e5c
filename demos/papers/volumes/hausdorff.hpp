// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <boxstream/function_ref.hpp>

#include "papers/volumes/oriented_box.hpp"
#include "papers/volumes/volume.hpp"

namespace boxstream::papers::volumes {

/// The box { centre + axes u : |u[i]| <= half[i] }.
struct Frame {
  Point centre;
  Eigen::Matrix3d axes;
  Point half;
};

template <Volume V>
Frame frame_around(const V& v) {
  const Aabb64 box = v.bounds();
  const Point low(box.min), high(box.max);
  return {(low + high) / 2, Eigen::Matrix3d::Identity(), (high - low) / 2};
}
inline Frame frame_around(const OrientedBox& v) {
  return {v.centre, v.axes, v.half};
}

/// The directed Hausdorff distance of Definition 3: max over b in B of `distance(b)`, that from b to the geometry.
/// B is where `excess` is at most 0 (see Volume), within `frame`. The result is below the true value by `tolerance` at
/// most, or by a few times that where corners of B are sharp.
///
/// Branch and bound: distances change no faster than places, so the middle of a cell bounds them in all of it.
double directed_hausdorff(const Frame& frame, FunctionRef<double(const Point&)> excess,
                          FunctionRef<double(const Point&)> distance, double tolerance);

}  // namespace boxstream::papers::volumes
