// SPDX-License-Identifier: MIT
#include "formats/import/mesh_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/read_file.hpp"
#include "formats/import/file_kind.hpp"
#include "formats/import/mesh_files/mesh_files.hpp"
#include "formats/import/mesh_files/text_scan.hpp"

namespace boxstream::imports {
namespace {

/// The value of an attribute of the element that begins at the front of `text`; empty if it has none.
std::string_view attribute(std::string_view text, std::string_view name) {
  text = text.substr(0, text.find('>'));
  for (std::size_t at = text.find(name); at < text.size(); at = text.find(name, at + 1)) {
    const std::string_view value = text.substr(at + name.size());
    if (at == 0 || text[at - 1] != ' ' || value.size() < 2 || value[0] != '=') continue;
    return value.substr(2, value.find(value[1], 2) - 2);
  }
  return {};
}

struct Rounding {
  std::size_t coordinates = 0, rounded = 0;
  double most = 0;

  void add(std::string_view numbers) {
    TextScan scan(numbers);
    for (std::string_view word = scan.word(); !word.empty(); word = scan.word()) {
      const std::optional<double> number = number_in(word);
      if (!number) continue;
      ++coordinates;
      const double off = std::abs(double{static_cast<float>(*number)} - *number);
      if (off == 0) continue;
      ++rounded;
      most = std::max(most, off);
    }
  }
};

/// The numbers of the source of this id.
std::string_view numbers_of(std::string_view text, std::string_view id) {
  for (std::size_t at = text.find("<source"); at < text.size(); at = text.find("<source", at + 1)) {
    if (attribute(text.substr(at), "id") != id) continue;
    const std::size_t array = text.find("<float_array", at), begin = text.find('>', array);
    if (array >= text.find("</source", at) || begin == text.npos) return {};
    return text.substr(begin + 1, text.find('<', begin) - begin - 1);
  }
  return {};
}

}  // namespace

std::string rounding_in_collada(std::string_view text) {
  Rounding rounding;
  for (std::size_t at = text.find("<input"); at < text.size(); at = text.find("<input", at + 1)) {
    const std::string_view source = attribute(text.substr(at), "source");
    if (attribute(text.substr(at), "semantic") == "POSITION" && source.size() > 1)
      rounding.add(numbers_of(text, source.substr(1)));
  }
  if (rounding.rounded == 0) return "";
  char most[32];
  std::snprintf(most, sizeof most, "%.2g", rounding.most);
  return std::to_string(rounding.rounded) + " of " + std::to_string(rounding.coordinates) +
         " coordinates are no floats and become floats, by up to " + most +
         ": .obj, .ply, .stl and .off are read as doubles";
}

std::string surface_note(const std::string& path) {
  const std::string kind = file_kind(path);
  if (kind != "dae" && kind != "stl") return "";
  const std::string bytes = files::read_file(path, std::uint64_t{512} << 20);
  return kind == "dae" ? rounding_in_collada(bytes) : unread_in_stl(bytes);
}

}  // namespace boxstream::imports
