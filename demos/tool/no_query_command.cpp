// SPDX-License-Identifier: MIT
#include "bad_input.hpp"
#include "commands.hpp"

namespace boxstream::tool {

int query_command(const QueryOptions&) {
  throw BadInput("this boxstream was built without FCL, which queries need (Debian: libfcl-dev)");
}

}  // namespace boxstream::tool
