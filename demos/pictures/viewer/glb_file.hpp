// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace boxstream::view {

/// A binary glTF 2.0 file (.glb) in the making: its JSON, and the numbers that the JSON points to.
class GlbFile {
 public:
  using Json = nlohmann::ordered_json;

  enum class Use { vertices, indices, animation };

  /// Appends `floats` / `components` elements and returns their accessor. `limits`: state their least and largest,
  /// which glTF demands of positions and times.
  std::size_t add_floats(const std::vector<float>& floats, std::size_t components, Use use, bool limits);
  std::size_t add_indices(const std::vector<std::uint32_t>& indices);

  /// `document` lacks what this class adds: asset version, buffers, buffer views and accessors.
  /// Throws std::length_error above 4 GiB, which the format cannot have.
  void write(std::ostream& out, Json document) const;

 private:
  struct View {
    std::string bytes;
    int target = 0;  // 0: none
  };
  View& view_for(Use use);

  std::vector<View> views_ = {{{}, 34962}, {{}, 34963}, {{}, 0}};  // in the order of Use
  Json accessors_ = Json::array();
};

}  // namespace boxstream::view
