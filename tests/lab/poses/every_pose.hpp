// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <ostream>
#include <string>

#include "hard_pose.hpp"

namespace boxstream::poses {

inline void PrintTo(const HardPose& pose, std::ostream* out) {
  *out << pose.name << " (" << pose.source << ")";
}

/// For INSTANTIATE_TEST_SUITE_P, which takes letters, digits and underscores only.
inline std::string test_name(const testing::TestParamInfo<HardPose>& info) {
  std::string name = info.param.name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

#define BOXSTREAM_FOR_EVERY_POSE(suite) \
  INSTANTIATE_TEST_SUITE_P(, suite, testing::ValuesIn(::boxstream::poses::all()), ::boxstream::poses::test_name)

}  // namespace boxstream::poses
