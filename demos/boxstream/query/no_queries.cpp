// SPDX-License-Identifier: MIT
#include "boxstream/query/run_queries.hpp"
#include "boxstream/shared/bad_input.hpp"

namespace boxstream::tool {

std::vector<std::string> manager_names() {
  return {};
}

int run_queries(const QueryOptions&) {
  throw BadInput("this boxstream was built without FCL, which queries need (Debian: libfcl-dev)");
}

}  // namespace boxstream::tool
