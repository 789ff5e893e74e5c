// SPDX-License-Identifier: MIT
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "golden_order.hpp"
#include "source_path.hpp"

namespace boxstream::tests {

/// Compares the order of pairs found with this executor with the recorded one, line by line.
inline void expect_golden_order(Executor* executor) {
  const std::string path = source_path("tests/library/core/golden_order.txt");
  std::ifstream file(path);
  ASSERT_TRUE(file) << path;
  std::vector<std::string> recorded;
  for (std::string line; std::getline(file, line);) recorded.push_back(line);
  const std::vector<std::string> lines = golden_order(executor);
  ASSERT_EQ(lines.size(), recorded.size());
  for (std::size_t i = 0; i < lines.size(); ++i)
    ASSERT_EQ(lines[i], recorded[i]) << "line " << i + 1
                                     << " of golden_order.txt. If the order was changed on purpose: "
                                     << "boxstream_golden_order > tests/library/core/golden_order.txt";
}

}  // namespace boxstream::tests
