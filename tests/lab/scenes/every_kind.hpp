// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/scene_json/json_text.hpp"
#include "source_path.hpp"

namespace boxstream::scenes_test {

/// A scene with every block, every kind of thing and every key, which the loader takes.
inline const std::string every_kind_file = tests::source_path("tests/lab/scenes/every_kind.json");

inline nlohmann::json every_kind() {
  return scenes::parse_json(scenes::read_text_file(every_kind_file), every_kind_file);
}

}  // namespace boxstream::scenes_test
