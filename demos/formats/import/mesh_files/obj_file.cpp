// SPDX-License-Identifier: MIT
#include <string>

#include "formats/import/mesh_files/mesh_files.hpp"
#include "formats/import/mesh_files/polygons.hpp"
#include "formats/import/mesh_files/text_scan.hpp"

namespace boxstream::imports {
namespace {

/// A comment ends with its line.
bool is_continued(std::string_view line) {
  return line.ends_with('\\') && line.find('#') == line.npos;
}

/// A line that a "\" at its end continues is one with the next.
std::string_view whole_line(TextScan& scan, std::string& joined) {
  std::string_view line = scan.line();
  if (!is_continued(line)) return line;
  joined.clear();
  while (is_continued(line)) {
    joined.append(line.substr(0, line.size() - 1)).push_back(' ');
    if (scan.at_end()) return joined;
    line = scan.line();
  }
  return joined.append(line);
}

/// "7", "7/1", "7//3" or "-1/..": from 1 on, or backwards from the last vertex before the line.
std::uint32_t corner_in(std::string_view word, std::size_t vertices) {
  const std::optional<std::int64_t> number = integer_in(word.substr(0, word.find('/')));
  if (!number) throw std::runtime_error("no number where a vertex should be: " + quoted(word));
  const std::int64_t index = *number > 0 ? *number - 1 : static_cast<std::int64_t>(vertices) + *number;
  if (*number == 0 || index < 0 || index > UINT32_MAX)
    throw std::runtime_error("a face with a vertex that is not there: " + quoted(word));
  return static_cast<std::uint32_t>(index);
}

}  // namespace

RawMesh read_obj(std::string_view bytes) {
  RawMesh mesh;
  Polygons faces(mesh);
  TextScan scan(TextScan::without_mark(bytes));
  std::string joined;
  std::vector<std::uint32_t> corners;
  try {
    while (!scan.at_end()) {
      const std::string_view line = whole_line(scan, joined);
      TextScan words(line.substr(0, line.find('#')));
      const std::string_view what = words.word();
      if (what == "v") {
        mesh.vertices.push_back(coordinates_in(words));
      } else if (what == "f" || what == "fo") {
        corners.clear();
        for (std::string_view word = words.word(); !word.empty(); word = words.word())
          corners.push_back(corner_in(word, mesh.vertices.size()));
        faces.add(corners);
      }
    }
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("line " + std::to_string(scan.lines()) + ": " + error.what());
  }
  faces.finish();
  return mesh;
}

}  // namespace boxstream::imports
