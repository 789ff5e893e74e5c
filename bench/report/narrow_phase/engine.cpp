// SPDX-License-Identifier: MIT
#include "narrow_phase/engine.hpp"

#include <stdexcept>

namespace boxstream::report::narrow {

Engine make_engine(const std::string& name, Query query, const Tuning& tuning, std::span<const Pose> poses) {
  const std::size_t space = name.find(' ');
  const std::string library = name.substr(0, space);
  const std::string solver = space == std::string::npos ? "" : name.substr(space + 1);
  if (library == "fcl") return make_fcl(solver, query, tuning, poses);
  if (library == "ccd") return make_ccd(solver, query, tuning, poses);
  if (library == "fcl_float") return make_fcl_float(solver, query, tuning, poses);
  if (library == "libccd") return make_libccd(solver, query, tuning, poses);
  if (library == "bullet") return make_bullet(solver, query, tuning, poses);
  throw std::invalid_argument("no engine \"" + name + "\"; there are ccd, fcl, fcl_float, libccd, bullet");
}

}  // namespace boxstream::report::narrow
