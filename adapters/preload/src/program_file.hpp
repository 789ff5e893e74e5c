// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace boxstream::preload {

/// The file that a shell would run; empty: there is none.
std::string find_program(const std::string& name);

/// Of a name for which there is none, in a whole sentence.
std::string why_not_found(const std::string& name);

/// Why nothing can be preloaded into a program, in words that follow its name; empty: it can.
std::string why_not_preloaded(const std::string& file);

}  // namespace boxstream::preload
