// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "process.hpp"

namespace boxstream::tool_test {

/// Exit code 2, nothing on standard output, and one line on standard error that has all of `parts`.
inline void expect_refusal(const Outcome& outcome, const std::vector<std::string>& parts = {}) {
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("boxstream: ") && outcome.err.ends_with("\n")) << outcome.err;
  for (const std::string& part : parts)
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << " in " << outcome.err;
}

}  // namespace boxstream::tool_test
