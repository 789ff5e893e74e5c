// SPDX-License-Identifier: MIT
#include <stdexcept>

#include "import/readers.hpp"

namespace boxstream::imports {

void read_bullet(const std::string&, Fragment&) {
  throw std::runtime_error("this build has no importer of Bullet (libbullet-extras), so it reads no .bullet files");
}

}  // namespace boxstream::imports
