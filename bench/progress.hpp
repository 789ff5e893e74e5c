// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace boxstream::bench {

/// A line on stderr that says what is being measured; nothing when stderr is no terminal.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const std::string& what);
  void clear();

 private:
  bool terminal_;
};

}  // namespace boxstream::bench
