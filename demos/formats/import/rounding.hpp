// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace boxstream::imports {

/// What becomes of the coordinates of a mesh's file that is read through assimp, which has floats: a line that says how
/// many of them are no floats; empty if all are, or the file is read as doubles. glTF has floats of its own.
std::string rounding_note(const std::string& path);

/// The same of the text of a Collada file.
std::string rounding_in_collada(std::string_view text);

}  // namespace boxstream::imports
