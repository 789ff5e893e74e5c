// SPDX-License-Identifier: MIT
#include "formats/import/mesh_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "base/read_file.hpp"
#include "formats/import/file_kind.hpp"
#include "formats/import/mesh_files/mesh_files.hpp"
#include "formats/import/mesh_files/text_scan.hpp"

namespace boxstream::imports {
namespace {

/// The value of an attribute of a tag; empty if it has none.
std::string_view attribute(std::string_view tag, std::string_view name) {
  for (std::size_t at = tag.find(name); at < tag.size(); at = tag.find(name, at + 1)) {
    const std::string_view value = tag.substr(at + name.size());
    const bool is_name = at != 0 && std::string_view(" \t\r\n").find(tag[at - 1]) != tag.npos;
    if (!is_name || value.size() < 2 || value[0] != '=') continue;
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

/// The numbers of sources, by id, and which of them are positions.
struct Sources {
  std::map<std::string_view, std::string_view> numbers;
  std::set<std::string_view> positions;
};

/// In one pass: a text may have as many sources as there is room for.
Sources sources_in(std::string_view text) {
  Sources sources;
  std::string_view id;  // of the source that the pass is in
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at + 1)) {
    const std::size_t end = std::min(text.find_first_of("<>", at + 1), text.size());
    const std::string_view tag = text.substr(at, end - at);
    if (tag.starts_with("<source")) {
      id = attribute(tag, "id");
    } else if (tag.starts_with("</source")) {
      id = {};
    } else if (tag.starts_with("<float_array") && !id.empty()) {
      const std::string_view rest = text.substr(std::min(end + 1, text.size()));
      sources.numbers.emplace(id, rest.substr(0, rest.find('<')));
    } else if (tag.starts_with("<input") && attribute(tag, "semantic") == "POSITION") {
      const std::string_view reference = attribute(tag, "source");
      if (reference.starts_with('#')) sources.positions.insert(reference.substr(1));
    }
  }
  return sources;
}

}  // namespace

std::string rounding_in_collada(std::string_view text) {
  const Sources sources = sources_in(text);
  Rounding rounding;
  for (const std::string_view id : sources.positions)
    if (const auto found = sources.numbers.find(id); found != sources.numbers.end()) rounding.add(found->second);
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
