// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace boxstream::imports {

/// The end of a file's name without the dot, in lower case: "stl".
std::string file_kind(const std::string& path);

/// Throws scenes::SceneError "FILE: reason", on one line whatever is in them: control characters become \xNN.
[[noreturn]] void fail(const std::string& file, const std::string& reason);

/// Throws scenes::SceneError unless `path` is a regular file of at most 512 MiB that can be opened.
void check_is_file(const std::string& path);

}  // namespace boxstream::imports
