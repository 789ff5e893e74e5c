// SPDX-License-Identifier: MIT
#include <stdexcept>

#include "import/readers.hpp"

namespace boxstream::imports {

void read_urdf(const std::string&, const ImportOptions&, Fragment&) {
  throw std::runtime_error("this build has no urdfdom, so it reads no URDF");
}

}  // namespace boxstream::imports
