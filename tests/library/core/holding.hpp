// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace boxstream::tests {

/// An exception that holds an object, as those of callers may hold much.
struct Holding : std::exception {
  explicit Holding(std::shared_ptr<int> object) : held(std::move(object)) {}
  std::shared_ptr<int> held;
};

/// Calls `run(raise)`, which is to let out the exception of `raise()`; once it is caught, nothing holds the object.
template <class Run>
void expect_gone_once_caught(const Run& run) {
  std::vector<std::weak_ptr<int>> thrown;
  const auto raise = [&] {
    auto object = std::make_shared<int>(0);
    thrown.emplace_back(object);
    throw Holding(std::move(object));
  };
  EXPECT_THROW(run(raise), std::exception);
  EXPECT_FALSE(thrown.empty());
  for (const auto& each : thrown) EXPECT_TRUE(each.expired());
}

}  // namespace boxstream::tests
