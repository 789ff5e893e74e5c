// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>

#include "formats/scene_json/load_parts.hpp"

namespace boxstream::scenes {
namespace {

/// The name of a file to write. What follows its last point says what is written.
std::string read_file_name(const Node& node, const std::vector<std::string>& extensions) {
  std::string name = node.text();
  const std::string extension = std::filesystem::path(name).extension().string();
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) {
    std::string known;
    for (const std::string& e : extensions) known += (known.empty() ? "" : " or ") + e;
    node.fail("must be a file name that ends in " + known);
  }
  return name;
}

}  // namespace

void load_outputs(const Node& node, Scene& scene) {
  Fields fields(node);
  Outputs& outputs = scene.outputs;
  if (const auto record = fields.find("record"))
    for (const Node& item : record->list(0, 10)) {
      const std::string name = read_file_name(item, {".bsrec", ".aabbs", ".glb"});
      if (std::find(outputs.record.begin(), outputs.record.end(), name) != outputs.record.end())
        item.fail("\"" + name + "\" is named twice");
      outputs.record.push_back(name);
    }
  if (const auto view = fields.find("view")) outputs.view = read_file_name(*view, {".html"});
  if (const auto csv = fields.find("csv")) outputs.csv = read_file_name(*csv, {".csv"});
  if (const auto trace = fields.find("trace")) outputs.trace = read_file_name(*trace, {".json"});
  fields.finish();
}

}  // namespace boxstream::scenes
