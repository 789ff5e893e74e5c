// SPDX-License-Identifier: MIT
#pragma once

namespace boxstream::tool {

/// Becomes the program of worlds in double precision, which reads the same command line; both precisions of Bullet have
/// the same names, so that they cannot be in one. It is beside this one, or in ../libexec/boxstream. Throws BadInput if
/// it is in neither.
[[noreturn]] void run_in_double();

}  // namespace boxstream::tool
