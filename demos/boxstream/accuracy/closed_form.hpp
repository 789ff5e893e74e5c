// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace boxstream::tool {

/// What must come of a world, by docs/internals/closed-forms.md.
struct ClosedForm {
  double truth = 0;
  std::string unit, about;
};

/// None: there is none of that name.
std::optional<ClosedForm> closed_form(const std::string& name);
std::vector<std::string> closed_form_names();

}  // namespace boxstream::tool
