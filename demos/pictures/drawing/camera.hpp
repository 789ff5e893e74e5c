// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "drawable.hpp"

namespace boxstream::picture {

/// A pinhole camera.
struct Camera {
  Vec3 eye{0, 2, 10};
  Vec3 target;
  Vec3 up{0, 1, 0};
  /// Full vertical angle of view.
  float field_of_view_degrees = 30;
  /// Radius about the target that matters; scenery well outside fades into the background.
  float scene_radius = 10;
};

/// Where the automatic camera looks from, as seen from the scene.
struct ViewDirection {
  float azimuth_degrees = 35;
  float elevation_degrees = 20;
};

/// A camera that shows the subjects among `drawables` in a picture of the given aspect (width / height).
/// Subjects that flew far away from the crowd, and a few in a thousand at its rim, may be out of the picture, so that
/// they do not shrink all others.
/// Without any subject it frames the scenery; without anything, a unit sphere at the origin.
Camera frame(std::span<const Drawable> drawables, float aspect, ViewDirection from = {});

}  // namespace boxstream::picture
