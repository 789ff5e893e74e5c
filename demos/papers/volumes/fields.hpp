// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "papers/volumes/objects.hpp"

namespace boxstream::papers::volumes {

/// A surface of `columns` x `rows` fields of two triangles each. `corner(column, row, out)` says where a corner is;
/// there is one more of these than of fields each way.
template <class Corner>
std::vector<Triangle> triangulated_fields(int columns, int rows, const Corner& corner) {
  std::vector<Triangle> triangles;
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < rows; ++row) {
      Triangle low{}, high{};
      corner(column, row, low.corners[0]);
      corner(column + 1, row, low.corners[1]);
      corner(column, row + 1, low.corners[2]);
      corner(column + 1, row, high.corners[0]);
      corner(column + 1, row + 1, high.corners[1]);
      corner(column, row + 1, high.corners[2]);
      triangles.push_back(low);
      triangles.push_back(high);
    }
  return triangles;
}

}  // namespace boxstream::papers::volumes
