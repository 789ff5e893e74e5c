// SPDX-License-Identifier: MIT
#pragma once

namespace boxstream::tool {

/// Reads the command line and does what it says. Returns the exit code. Throws BadInput for a wrong command line, and
/// what the command throws.
int run(int argc, char** argv);

/// Those that run() was called with, the name of the program first and a null last.
char**& given_arguments();

}  // namespace boxstream::tool
