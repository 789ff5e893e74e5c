// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace boxstream::imports {

/// What is not as it is in the file after it has been read, in a line; empty if all is. Of Collada, which is read
/// through assimp, which has floats, how many coordinates are none (glTF has floats of its own); of binary STL,
/// triangles that it does not count.
std::string surface_note(const std::string& path);

/// That of the text of a Collada file.
std::string rounding_in_collada(std::string_view text);

}  // namespace boxstream::imports
