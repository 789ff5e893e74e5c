// SPDX-License-Identifier: MIT
#pragma once

#include "formats/scene_json/load_parts.hpp"

/// The readers of generators, and what several of them share.
namespace boxstream::scenes {

std::array<int, 2> read_columns(const Node& node);
std::array<double, 2> read_two_sizes(const Node& node);
enum class MixTypes { dynamic_only, any };
std::vector<MixEntry> read_mix(Fields& fields, const Scene& scene, const Names& names,
                               MixTypes types = MixTypes::dynamic_only);
/// A nested object with the traits of one body.
BodyTraits read_part(Fields& fields, const std::string& key, const Scene& scene, const Names& names);
/// The same, of a body whose shape is a box.
BodyTraits read_box_part(Fields& fields, const std::string& key, const Scene& scene, const Names& names);

Generator read_ball_random(Fields& fields, const Scene& scene, const Names& names);
Generator read_assorted80(Fields& fields, const Scene& scene, const Names& names);
Generator read_joint_grid(Fields& fields, const Scene& scene, const Names& names);
Generator read_drum(Fields& fields, const Scene&, const Names& names);

}  // namespace boxstream::scenes
