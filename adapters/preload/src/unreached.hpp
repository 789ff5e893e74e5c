// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace boxstream::preload {

/// Says, one a line, which broad-phases of the process are not reached: those that a file has within itself, those that
/// it takes from an engine's library past the preloaded one, and those of kinds that are not replaced.
void find_unreached(char* lines, std::size_t size);

}  // namespace boxstream::preload
