// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "camera.hpp"
#include "drawable.hpp"
#include "png_file.hpp"

namespace boxstream::picture {

struct RenderOptions {
  int width = 1200;
  int height = 675;
  /// Rays a pixel, rounded up to a multiple of 8. More: less grain, longer.
  int samples = 16;
  /// 0: one for each hardware thread.
  int threads = 0;
};

/// A still of `drawables` under a soft sun and an open sky. The image does not depend on the number of threads.
/// Throws std::runtime_error when Embree cannot start or runs out of memory.
Image render(std::span<const Drawable> drawables, const Camera& camera, const RenderOptions& options = {});

}  // namespace boxstream::picture
