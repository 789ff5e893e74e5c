// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace boxstream::scenes {

/// Parses JSON text. Throws SceneError naming `file` and the place for what is no JSON, for numbers beyond the range of
/// double, for a key given twice and for nesting deeper than a scene ever is.
nlohmann::json parse_json(const std::string& text, const std::string& file);

/// The whole of a file of at most 256 MiB. Throws SceneError "PATH: reason".
std::string read_text_file(const std::string& path);

/// "FILE: POINTER: reason" on one line, whatever is in the names. The whole document is "/".
std::string error_line(const std::string& file, const std::string& pointer, const std::string& reason);

/// An error line of a document, with the name of the body, or of the body whose joint it is, that its pointer leads to:
/// files of other programs have names and no numbers.
std::string with_name(const std::string& line, const std::string& file, const nlohmann::json& document);

/// `pointer` extended by one key, escaped as RFC 6901 says.
std::string child_pointer(const std::string& pointer, const std::string& key);

}  // namespace boxstream::scenes
