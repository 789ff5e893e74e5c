// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <fstream>
#include <istream>
#include <string>

namespace boxstream::files {

/// A file that is read piece by piece, or standard input for "-". Noted as read.
class InputFile {
 public:
  /// Throws BadFile for what cannot be read.
  explicit InputFile(const std::string& name);

  std::istream& stream();
  /// What is still to come. Throws BadFile for more than `most` bytes.
  std::string read_rest(std::uint64_t most);

 private:
  std::string name_;
  std::ifstream file_;
};

}  // namespace boxstream::files
