// SPDX-License-Identifier: MIT
#include "base/input_file.hpp"

#include <cerrno>
#include <cstring>
#include <iostream>

#include "base/bad_file.hpp"
#include "base/read_file.hpp"

namespace boxstream::files {

InputFile::InputFile(const std::string& name) : name_(name == "-" ? "standard input" : name) {
  note_read(name);
  if (name == "-") return;
  errno = 0;
  file_.open(name, std::ios::binary);
  // A directory can be opened, but not read.
  const bool readable = file_ && (file_.peek() != std::ifstream::traits_type::eof() || errno == 0);
  if (!readable) throw BadFile(name_, std::strerror(errno));
  file_.clear();
}

std::istream& InputFile::stream() {
  return file_.is_open() ? static_cast<std::istream&>(file_) : std::cin;
}

std::string InputFile::read_rest(std::uint64_t most) {
  std::string text;
  char block[65536];
  for (;;) {
    stream().read(block, sizeof block);
    text.append(block, static_cast<std::size_t>(stream().gcount()));
    if (text.size() > most) throw BadFile(name_, "larger than " + mebibytes(most));
    if (!stream()) return text;
  }
}

}  // namespace boxstream::files
