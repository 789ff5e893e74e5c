// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <set>

#include "formats/scene_json/load_parts.hpp"

namespace boxstream::scenes {
namespace {

/// Reads what `key` lists into `effects`; `seen` has the names of all lists so far.
void read_effects(Fields& fields, const char* key, std::vector<std::string>& effects, std::set<std::string>& seen) {
  const auto list = fields.find(key);
  if (!list) return;
  for (const Node& item : list->list(0, 100)) {
    const std::string& name = effects.emplace_back(item.text());
    if (!seen.insert(name).second) item.fail("\"" + name + "\" is named twice");
  }
}

/// "at": a step, "end" or "always".
void read_when(Fields& fields, const Scene& scene, Check& check) {
  const auto at = fields.find("at");
  if (!at) return;
  if (at->is_string()) {
    check.at_end = at->choice({"always", "end"}) == 1;
    return;
  }
  const int step = at->integer(1, 10'000'000);
  if (step > scene.time.steps)
    at->fail("the run ends after step " + std::to_string(scene.time.steps) + ", before this check");
  check.at = static_cast<std::uint64_t>(step);
}

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

void load_effects(const Node& node, Scene& scene) {
  Fields fields(node);
  std::set<std::string> seen;
  read_effects(fields, "require", scene.effects.require, seen);
  read_effects(fields, "forbid", scene.effects.forbid, seen);
  fields.finish();
}

void load_checks(const Node& node, Scene& scene) {
  for (const Node& item : node.list(0, 1000)) {
    Fields fields(item);
    Check check;
    check.metric = static_cast<Check::Metric>(fields.require("metric").choice(metric_names()));
    check.op = static_cast<Check::Op>(fields.require("op").choice(op_names()));
    check.value = fields.number("value", {});
    read_when(fields, scene, check);
    fields.finish();
    scene.checks.push_back(check);
  }
}

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

void load_expect(const Node& node, Scene& scene) {
  Fields fields(node);
  Expect& e = scene.expect;
  for_each_count(e, e, [&](const char* key, std::optional<std::uint64_t>& count, auto&) {
    if (const auto found = fields.find(key)) count = found->count();
  });
  if (const auto ratio = fields.find("size_ratio")) e.size_ratio = ratio->number({1, 1e6});
  fields.finish();
}

}  // namespace boxstream::scenes
