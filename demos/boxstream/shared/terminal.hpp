// SPDX-License-Identifier: MIT
#pragma once

namespace boxstream::tool {

/// Whether what is written there goes to a terminal that can move its cursor. `descriptor` as of isatty.
bool is_terminal(int descriptor);

/// Whether it shows colours, too, and its user wants them: NO_COLOR (no-color.org) is not set.
bool shows_colours(int descriptor);

}  // namespace boxstream::tool
