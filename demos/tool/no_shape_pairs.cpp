// SPDX-License-Identifier: MIT
#include "bad_input.hpp"
#include "shape_pairs.hpp"

namespace boxstream::tool {

int shape_pairs(const std::string&, const std::string& name, const PairsOptions&) {
  throw BadInput(name +
                 ": this boxstream was built without libccd and Eigen, which shapes need "
                 "(Debian: libccd-dev libeigen3-dev)");
}

}  // namespace boxstream::tool
