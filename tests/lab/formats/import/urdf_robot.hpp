// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <string>

#include "formats/import/geometry.hpp"
#include "formats/import/import_file.hpp"
#include "formats/scene_model/scene_error.hpp"
#include "scratch_directory.hpp"

namespace boxstream::import_test {

using imports::ImportOptions;
using nlohmann::json;
using scenes::Vec3;
using tool_test::ScratchDirectory;

/// A post, and on it a bar that turns about y, 2 m up. z is up.
inline const char* const post_and_bar = R"(<robot name="r">
  <link name="post">
    <inertial><origin xyz="0 0 1"/><mass value="10"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><origin xyz="0 0 1"/><geometry><box size="0.2 0.2 2"/></geometry></collision>
  </link>
  <joint name="hinge" type="revolute">
    <parent link="post"/><child link="bar"/><origin xyz="0 0 2.1"/><axis xyz="0 1 0"/>
    <limit lower="-0.5" upper="1" effort="30" velocity="0"/>
  </joint>
  <link name="bar">
    <inertial><origin xyz="0.5 0 0"/><mass value="2"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><origin xyz="0.5 0 0"/><geometry><box size="1 0.1 0.1"/></geometry></collision>
  </link>
</robot>)";

inline std::string without(std::string text, const std::string& part, const std::string& instead = "") {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return at == std::string::npos ? text : text.replace(at, part.size(), instead);
}

inline json import(const std::string& text, const ImportOptions& options = {}) {
  const ScratchDirectory scratch;
  return json::parse(imports::import_file(scratch.write("r.urdf", text), options));
}

inline std::string complaint(const std::string& text, const ImportOptions& options = {}) {
  const ScratchDirectory scratch;
  const std::string path = scratch.write("r.urdf", text);
  try {
    imports::import_file(path, options);
  } catch (const scenes::SceneError& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.substr(0, path.size() + 2), path + ": ");
    EXPECT_EQ(line.find('\n'), std::string::npos);
    return line.substr(path.size() + 2);
  }
  return {};
}

inline void expect_near(const json& values, const Vec3& expected) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(values[i].get<double>(), expected[i], 1e-12) << values;
}

}  // namespace boxstream::import_test
