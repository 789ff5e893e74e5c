// SPDX-License-Identifier: MIT
#include "boxstream/accuracy/closed_form.hpp"

#include <nlohmann/json.hpp>

namespace boxstream::tool {

/// closed_forms.json, made by tests/lab/scenes/closed_forms.py.
extern const char* const closed_forms_json;

namespace {

const nlohmann::json& all() {
  static const nlohmann::json document = nlohmann::json::parse(closed_forms_json);
  return document;
}

}  // namespace

std::optional<ClosedForm> closed_form(const std::string& name) {
  const auto found = all().find(name);
  if (found == all().end()) return std::nullopt;
  return ClosedForm{found->at("truth"), found->at("unit"), found->at("about")};
}

std::vector<std::string> closed_form_names() {
  std::vector<std::string> names;
  for (const auto& [name, form] : all().items()) names.push_back(name);
  return names;
}

}  // namespace boxstream::tool
