// SPDX-License-Identifier: MIT
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
    at->fail("the run ends after step " + std::to_string(scene.time.steps) + ", and would never ask");
  check.at = static_cast<std::uint64_t>(step);
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

}  // namespace boxstream::scenes
