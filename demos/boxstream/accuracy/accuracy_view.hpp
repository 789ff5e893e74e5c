// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>

#include "accuracy/sweep.hpp"
#include "boxstream/shared/print.hpp"

namespace boxstream::tool {

/// Throws BadInput unless the page can be made: `name` ends in .html, the viewer is built in, and there are two
/// settings.
void check_view(const std::string& name, const accuracy::Request& request);

/// Runs the scene with the first and with the last setting, and writes a page that plays both side by side. Throws as
/// accuracy::run and view::Recording.
void write_accuracy_view(const accuracy::Request& request, std::ostream& out, StatusLine& status);

}  // namespace boxstream::tool
