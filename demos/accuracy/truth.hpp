// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace boxstream::accuracy {

/// What is known of a scene from elsewhere: by a formula, an experiment, or another program.
struct Truth {
  struct Point {
    double seconds = 0;
    std::array<double, 3> place{};  ///< m
  };
  std::vector<Point> points;    ///< where the request's body is, in order of time
  std::optional<double> value;  ///< of the first measure
};

/// Lines "seconds,x,y,z" under a header with these four names, among others. Throws BadKnob with the line's number.
std::vector<Truth::Point> read_truth(std::istream& file, const std::string& name);

}  // namespace boxstream::accuracy
