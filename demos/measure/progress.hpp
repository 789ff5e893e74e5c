// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <cstdio>
#include <string>

namespace boxstream::measure {

/// A line on stderr with the name of what is being measured; nothing when stderr is no terminal.
class Progress {
 public:
  Progress() = default;
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const std::string& what) {
    if (terminal_) std::fprintf(stderr, "\r\033[K%s", what.c_str());
  }
  void clear() { show(""); }

 private:
  bool terminal_ = isatty(STDERR_FILENO) == 1;
};

}  // namespace boxstream::measure
