// SPDX-License-Identifier: MIT
#include "formats/import/urdf_files.hpp"

#include <filesystem>
#include <locale>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "base/read_file.hpp"

namespace boxstream::imports {
namespace {

namespace fs = std::filesystem;

const std::string package_scheme = "package://", file_scheme = "file://", capsule_scheme = "capsule:";

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::vector<fs::path> and_above(fs::path place) {
  std::vector<fs::path> places{place};
  for (; place != place.parent_path(); place = place.parent_path()) places.push_back(place.parent_path());
  return places;
}

/// Some write package:///NAME.
fs::path without_slashes(const std::string& name) {
  const std::size_t first = name.find_first_not_of('/');
  return first == std::string::npos ? fs::path() : fs::path(name.substr(first));
}

std::string attribute(const std::string& tag, const std::string& name) {
  const std::regex pattern("\\b" + name + "\\s*=\\s*[\"']([^\"']*)[\"']");
  std::smatch found;
  return std::regex_search(tag, found, pattern) ? found[1].str() : "";
}

bool is_within(const std::string& folder, const fs::path& place) {
  return folder.empty() || files::is_below(folder, place.string());
}

/// In a package.
std::string find_in_packages(const fs::path& from, const std::string& name, const std::vector<std::string>& packages,
                             const std::string& within) {
  const fs::path whole = without_slashes(name.substr(package_scheme.size()));
  if (whole.empty()) throw std::runtime_error("a mesh without a name");
  const fs::path package = *whole.begin(), rest = whole.lexically_relative(package);
  std::vector<fs::path> places(packages.begin(), packages.end());
  for (const fs::path& above : and_above(from))
    if (is_within(within, above)) places.push_back(above);
  // What lies outside is not there, or messages would say whether it is.
  const auto is_there = [&](const fs::path& file) { return is_within(within, file) && is_file(file); };
  for (const fs::path& place : places) {
    if (is_there(place / whole)) return (place / whole).string();
    if (place.filename() == package && is_there(place / rest)) return (place / rest).string();
  }
  for (const fs::path& place : places)
    if (is_there(place / rest)) return (place / rest).string();
  std::string searched;
  for (const std::string& place : packages) searched += place + ", ";
  throw std::runtime_error(name + ": no such file; searched " + searched + from.string() +
                           " and all folders above it; --package-path names others");
}

}  // namespace

std::string find_mesh(const std::string& urdf, const std::string& name, const std::vector<std::string>& packages,
                      const std::string& within) {
  const fs::path from = fs::absolute(urdf).parent_path();
  const std::string place = name.starts_with(file_scheme)      ? name.substr(file_scheme.size())
                            : name.starts_with(package_scheme) ? find_in_packages(from, name, packages, within)
                                                               : (from / name).string();
  if (!is_within(within, place)) throw std::runtime_error(name + ": outside of the scene's folder");
  return place;
}

std::string with_capsules_as_meshes(const std::string& text) {
  if (text.find("<capsule") == std::string::npos) return text;
  static const std::regex tag("<capsule(\\s[^<>]*?)?(/?)>");
  std::string result;
  auto end = text.cbegin();
  for (std::sregex_iterator it(text.begin(), text.end(), tag), last; it != last; ++it) {
    const std::smatch& found = *it;
    result.append(end, found[0].first);
    result += "<mesh filename=\"" + capsule_scheme + attribute(found[1], "radius") + " " +
              attribute(found[1], "length") + "\"" + found[2].str() + ">";
    end = found[0].second;
  }
  result.append(end, text.cend());
  return std::regex_replace(result, std::regex("</capsule\\s*>"), "</mesh>");
}

bool is_capsule(const std::string& mesh_name) {
  return mesh_name.starts_with(capsule_scheme);
}

CapsuleSize capsule_size(const std::string& mesh_name) {
  std::istringstream numbers(mesh_name.substr(capsule_scheme.size()));
  numbers.imbue(std::locale::classic());
  CapsuleSize size{};
  if (!(numbers >> size.radius >> size.length)) throw std::runtime_error("a capsule without radius and length");
  return size;
}

}  // namespace boxstream::imports
