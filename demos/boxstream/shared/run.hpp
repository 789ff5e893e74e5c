// SPDX-License-Identifier: MIT
#pragma once

namespace boxstream::tool {

/// Reads the command line and does what it says. Returns the exit code. Throws BadInput for a wrong command line, and
/// what the command throws.
int run(int argc, char** argv);

}  // namespace boxstream::tool
