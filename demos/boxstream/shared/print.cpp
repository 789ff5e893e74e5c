// SPDX-License-Identifier: MIT
#include "boxstream/shared/print.hpp"

#include <unistd.h>

#include <cstdio>
#include <regex>
#include <stdexcept>

#include "base/printable.hpp"
#include "boxstream/shared/terminal.hpp"

namespace boxstream::tool {
namespace {

/// Errors of the library begin with its name, which is that of the tool.
void write_remark(const char* begin, const std::string& text, const char* end) {
  const std::string name = "boxstream: ";
  const std::size_t from = text.compare(0, name.size(), name) == 0 ? name.size() : 0;
  std::fprintf(stderr, "%sboxstream:%s %s\n", begin, end, files::printable(text.substr(from)).c_str());
}

}  // namespace

void print_raw(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw std::runtime_error("standard output: cannot be written");
}

void print(const std::string& text) {
  print_raw(files::printable_lines(text));
}

void print_help(const std::string& text) {
  const std::string lines = files::printable_lines(text);
  static const std::regex heading("(^|\n)([A-Z][a-z]+:)");
  print_raw(shows_colours(STDOUT_FILENO) ? std::regex_replace(lines, heading, "$1\x1b[1m$2\x1b[0m") : lines);
}

void remark(const std::string& text) noexcept try { write_remark("", text, ""); } catch (...) {
  std::fputs("boxstream: out of memory\n", stderr);
}

void complain(const std::string& text) noexcept try {
  if (!shows_colours(STDERR_FILENO)) return remark(text);
  write_remark("\x1b[1;31m", text, "\x1b[0m");
} catch (...) {
  std::fputs("boxstream: out of memory\n", stderr);
}

}  // namespace boxstream::tool
