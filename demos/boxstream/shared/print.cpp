// SPDX-License-Identifier: MIT
#include "boxstream/shared/print.hpp"

#include <cstdio>
#include <stdexcept>

#include "base/printable.hpp"

namespace boxstream::tool {

void print(const std::string& text) {
  const std::string lines = files::printable_lines(text);
  if (std::fwrite(lines.data(), 1, lines.size(), stdout) != lines.size() || std::fflush(stdout) != 0)
    throw std::runtime_error("standard output: cannot be written");
}

void remark(const std::string& text) noexcept try {
  std::fprintf(stderr, "boxstream: %s\n", files::printable(text).c_str());
} catch (...) {
  std::fputs("boxstream: out of memory\n", stderr);
}

}  // namespace boxstream::tool
