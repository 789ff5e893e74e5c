// SPDX-License-Identifier: MIT
#include "write_text.hpp"

#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace boxstream::tool {

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

void print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw std::runtime_error("standard output: cannot be written");
}

}  // namespace boxstream::tool
