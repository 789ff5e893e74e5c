// SPDX-License-Identifier: MIT
#include <boxstream/ccd.hpp>

namespace boxstream::ccd {

const char* name(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::inexact:
      return "inexact";
    case Status::iteration_limit:
      return "iteration limit";
    case Status::invalid_input:
      return "invalid input";
  }
  return "";
}

const char* name(Method method) {
  switch (method) {
    case Method::none:
      return "none";
    case Method::cores:
      return "cores";
    case Method::gjk:
      return "gjk";
    case Method::epa:
      return "epa";
    case Method::mpr:
      return "mpr";
    case Method::axes:
      return "axes";
  }
  return "";
}

}  // namespace boxstream::ccd
