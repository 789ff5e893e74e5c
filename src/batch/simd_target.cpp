// SPDX-License-Identifier: MIT
#include <hwy/highway.h>

#include <boxstream/detector.hpp>

namespace boxstream {

const char* simd_target() {
  const auto compiled = HWY_SUPPORTED_TARGETS & static_cast<decltype(hwy::SupportedTargets())>(HWY_TARGETS);
  return hwy::TargetName(compiled & -compiled);  // the lowest bit is the best
}

}  // namespace boxstream
