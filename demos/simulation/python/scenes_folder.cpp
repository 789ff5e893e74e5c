// SPDX-License-Identifier: MIT
#include "scenes_folder.hpp"

namespace boxstream::scenes {

const char* const scenes_folder = BOXSTREAM_SCENES_DIR;

}  // namespace boxstream::scenes
