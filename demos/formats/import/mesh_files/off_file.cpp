// SPDX-License-Identifier: MIT
#include "formats/import/mesh_files/mesh_files.hpp"
#include "formats/import/mesh_files/polygons.hpp"
#include "formats/import/mesh_files/text_scan.hpp"

namespace boxstream::imports {
namespace {

/// The next line that has something beside a comment.
std::string_view next_line(TextScan& scan) {
  while (!scan.at_end()) {
    std::string_view line = scan.line();
    line = line.substr(0, line.find('#'));
    if (!TextScan(line).word().empty()) return line;
  }
  throw std::runtime_error("cut off, or more than one vertex or face in a line");
}

std::size_t count_in(TextScan& words, const char* what) {
  const std::string_view word = words.word();
  const std::optional<std::int64_t> count = integer_in(word);
  if (!count || *count < 0) throw std::runtime_error(std::string("no number of ") + what + ": " + quoted(word));
  return static_cast<std::size_t>(*count);
}

RawMesh read_lines(TextScan& scan) {
  std::string_view line = next_line(scan);
  TextScan words(line);
  std::string_view kind = words.word();
  if (kind.starts_with("OFF")) kind = kind.substr(0, 3);  // files of ModelNet have the first number right behind it
  if (kind.ends_with("OFF") || kind == "off") {
    if (kind.find_first_of("4n") != kind.npos)
      throw std::runtime_error("surfaces of other than three dimensions are not read");
    if (words.word() == "BINARY") throw std::runtime_error("binary OFF is not read");
    line = TextScan(line.substr(kind.data() + kind.size() - line.data())).word().empty()
               ? next_line(scan)
               : line.substr(kind.data() + kind.size() - line.data());
  }
  TextScan counts(line);
  const std::size_t vertices = count_in(counts, "vertices"), count = count_in(counts, "faces");
  RawMesh mesh;
  Polygons faces(mesh);
  for (std::size_t i = 0; i < vertices; ++i) {
    TextScan coordinates(next_line(scan));
    mesh.vertices.push_back(coordinates_in(coordinates));
  }
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < count; ++i) {
    TextScan numbers(next_line(scan));
    const std::size_t size = count_in(numbers, "corners");
    corners.clear();
    for (std::size_t k = 0; k < size; ++k) {
      const std::string_view word = numbers.word();
      const std::optional<std::int64_t> corner = integer_in(word);
      if (!corner || *corner < 0 || *corner >= static_cast<std::int64_t>(vertices))
        throw std::runtime_error("a face with a vertex that is not there: " + quoted(word));
      corners.push_back(static_cast<std::uint32_t>(*corner));
    }
    faces.add(corners);
  }
  faces.finish();
  return mesh;
}

}  // namespace

RawMesh read_off(std::string_view bytes) {
  TextScan scan(TextScan::without_mark(bytes));
  try {
    return read_lines(scan);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("line " + std::to_string(scan.lines()) + ": " + error.what());
  }
}

}  // namespace boxstream::imports
