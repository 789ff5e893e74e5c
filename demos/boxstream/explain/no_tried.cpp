// SPDX-License-Identifier: MIT
#include "boxstream/explain/tried.hpp"
#include "boxstream/shared/bad_input.hpp"

namespace boxstream::tool {

Tried try_settings(const std::string&, double) {
  throw BadInput(
      "--try: this boxstream was built without the part that runs scenes at other settings (./dev build has it)");
}

}  // namespace boxstream::tool
