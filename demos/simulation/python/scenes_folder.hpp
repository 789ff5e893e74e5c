// SPDX-License-Identifier: MIT
#pragma once

namespace boxstream::scenes {

/// Where boxstream.simulate finds scenes by name: BOXSTREAM_PYTHON_SCENES of the build.
extern const char* const scenes_folder;

}  // namespace boxstream::scenes
