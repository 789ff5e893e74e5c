// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "formats/import/mesh_files/mesh_files.hpp"
#include "formats/import/mesh_files/text_scan.hpp"

namespace boxstream::imports {
namespace {

constexpr std::size_t header = 84, facet = 50;  // bytes

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << 8 * i;
  return value;
}

/// How many facets a binary file says it has; 0 for what is too short to say so.
std::size_t count_in(std::string_view bytes) {
  return bytes.size() < header ? 0 : little_endian(bytes, 80);
}

void add_facet(RawMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size() - 3);
  mesh.faces.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
  mesh.triangles.push_back({first, first + 1, first + 2});
}

RawMesh read_binary(std::string_view bytes) {
  const std::size_t count = count_in(bytes);
  if (bytes.size() < header || (bytes.size() - header) / facet < count)
    throw std::runtime_error("cut off: " + std::to_string(count) + " triangles take " +
                             std::to_string(header + facet * count) + " bytes");
  if (count == 0 && !unread_in_stl(bytes).empty()) throw std::runtime_error(unread_in_stl(bytes));
  RawMesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = header + facet * i + 12;  // after the normal
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::array<double, 3> place{};
      for (std::size_t d = 0; d < 3; ++d)
        place[d] = double{std::bit_cast<float>(little_endian(bytes, at + 12 * corner + 4 * d))};
      mesh.vertices.push_back(place);
    }
    add_facet(mesh);
  }
  return mesh;
}

/// Whether these are the letters of a keyword, of either case.
bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](char x, char y) { return x == y || (x >= 'A' && x <= 'Z' && x - 'A' + 'a' == y); });
}

/// Whether a word, and the one before it, end a solid: some programs write "end solid", others write the name without a
/// blank before it.
bool ends_solid(std::string_view word, std::string_view before) {
  return is_keyword(word.substr(0, 8), "endsolid") || (is_keyword(word, "solid") && is_keyword(before, "end"));
}

RawMesh read_text(std::string_view text) {
  RawMesh mesh;
  TextScan scan(text);
  try {
    std::size_t corners = 0;
    bool in_facet = false;
    while (!scan.at_end()) {
      TextScan words(scan.line());
      std::string_view before;
      for (std::string_view word = words.word(); !word.empty(); before = std::exchange(word, words.word())) {
        if (is_keyword(word, "solid") || ends_solid(word, before)) break;  // what follows is a name
        if (is_keyword(word, "facet")) {
          in_facet = !is_keyword(before, "end");
        } else if (is_keyword(word, "vertex")) {
          mesh.vertices.push_back(coordinates_in(words));
          ++corners;
        } else if (is_keyword(word, "endloop")) {
          if (corners != 3) throw std::runtime_error("a facet of " + std::to_string(corners) + " vertices");
          add_facet(mesh);
          corners = 0;
          in_facet = false;
        }
      }
    }
    if (in_facet || corners != 0) throw std::runtime_error("cut off");
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("line " + std::to_string(scan.lines()) + ": " + error.what());
  }
  return mesh;
}

/// Whether the last line that is not empty ends a solid.
bool has_end(std::string_view text) {
  text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
  TextScan words(text.substr(text.find_last_of("\r\n") + 1));
  const std::string_view first = words.word();
  return ends_solid(first, "") || ends_solid(words.word(), first);
}

bool begins_solid(std::string_view bytes) {
  return is_keyword(TextScan(TextScan::without_mark(bytes)).word(), "solid");
}

/// Files of bytes may begin with "solid", too: their size tells, or a zero, which no text has.
bool is_binary(std::string_view bytes) {
  if (bytes.size() >= header && bytes.size() == header + facet * count_in(bytes)) return true;
  if (bytes.substr(0, header).find('\0') != bytes.npos) return true;
  if (begins_solid(bytes)) return false;
  // Bytes of a count and of floats are hardly ever all letters.
  return !std::all_of(bytes.begin(), bytes.end(), [](unsigned char c) { return c >= ' ' || (c >= '\t' && c <= '\r'); });
}

}  // namespace

std::string unread_in_stl(std::string_view bytes) {
  if (!is_binary(bytes))
    return !begins_solid(bytes) || has_end(bytes) ? "" : "no endsolid after its last facet: it may be cut off";
  if (bytes.size() < header) return "";
  // Some programs leave the count as it was before they wrote the triangles.
  const std::size_t count = count_in(bytes), room = (bytes.size() - header) / facet;
  if (room <= count) return "";
  return "its count is " + std::to_string(count) + " triangles, and there are bytes of " + std::to_string(room) +
         ": the rest is not read";
}

RawMesh read_stl(std::string_view bytes) {
  if (is_binary(bytes)) return read_binary(bytes);
  if (begins_solid(bytes)) return read_text(TextScan::without_mark(bytes));
  throw std::runtime_error("a text that does not begin with \"solid\"");
}

}  // namespace boxstream::imports
