// SPDX-License-Identifier: MIT
#include "boxes_file.hpp"

#include <fmt/format.h>

#include "number_rows.hpp"

namespace boxstream::tool {

std::vector<Aabb64> read_boxes(std::istream& in, const std::string& name, std::size_t first_line) {
  std::vector<Aabb64> boxes;
  read_number_rows(
      in, name, 6,
      [&](const std::vector<double>& row) -> std::string {
        if (row.size() < 6) return fmt::format("{} numbers, expected 6", row.size());
        Aabb64& box = boxes.emplace_back();
        for (std::size_t d = 0; d < 3; ++d) {
          if (row[d] > row[d + 3]) return fmt::format("min > max on the {} axis", "xyz"[d]);
          box.min[d] = row[d];
          box.max[d] = row[d + 3];
        }
        return {};
      },
      first_line);
  return boxes;
}

}  // namespace boxstream::tool
