// SPDX-License-Identifier: MIT
#pragma once

#include "tally.hpp"

namespace boxstream::preload {

/// The tally of this process: a file in the folder that BOXSTREAM_TRY_TALLIES names, else memory of this process alone.
Tally& own_tally();

}  // namespace boxstream::preload
