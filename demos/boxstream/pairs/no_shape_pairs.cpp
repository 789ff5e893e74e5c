// SPDX-License-Identifier: MIT
#include "boxstream/pairs/shape_pairs.hpp"
#include "boxstream/shared/bad_input.hpp"

namespace boxstream::tool {

int shape_pairs(const std::string&, const std::string& name, bool, const NarrowOptions&) {
  throw BadInput(name +
                 ": this boxstream was built without libccd and Eigen, which shapes need "
                 "(Debian: libccd-dev libeigen3-dev)");
}

}  // namespace boxstream::tool
