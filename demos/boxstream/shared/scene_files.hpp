// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "boxstream/shared/command_line.hpp"
#include "formats/scene_model/scene.hpp"

namespace boxstream::tool {

/// Scenes of queries are those whose names begin with "query_".
enum class SceneKind { simulation, query };

/// Where the program is; empty if that cannot be told.
std::filesystem::path executable_directory();

/// The scene files of one kind that come with the tool, sorted by name; empty if there are none where the tool expects
/// them: in `scenes` beside the executable, or in share/boxstream/scenes one or two folders above.
std::vector<std::filesystem::path> shipped_scenes(SceneKind kind);

/// Their names, as in "pile", and behind them those in folders, as in "effects/wind", which `boxstream list` leaves
/// out: there is one for each effect.
std::vector<std::string> scene_names(SceneKind kind);

/// The argument SCENE: a file or the name of a scene.
CLI::Option* add_scene(CommandLine& command, std::string& scene, SceneKind kind);

/// The file meant by `name`: a path, or the bare name of a shipped scene ("pile"). Throws BadInput with the names of
/// the shipped scenes of this kind if it is neither.
std::filesystem::path resolve_scene(const std::string& name, SceneKind kind);

/// Says on standard error which words of the scene's file are those of an older version, in one line, and what the
/// files that it imports have that the scene does not have, a line each.
void note_what_was_read(const scenes::Scene& scene);

/// The scene meant by `name`, with about `scale` times as many bodies (scenes::scaled), with notes as
/// note_what_was_read() has them. Throws BadInput, SceneError.
scenes::Scene load_scaled(const std::string& name, double scale);

}  // namespace boxstream::tool
