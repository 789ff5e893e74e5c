// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace boxstream::bench {

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}
Progress::~Progress() {
  clear();
}

void Progress::show(const std::string& what) {
  if (terminal_) std::fprintf(stderr, "\r\033[K%s", what.c_str());
}

void Progress::clear() {
  show("");
}

}  // namespace boxstream::bench
