// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <fstream>
#include <istream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace boxstream::files {

/// A file that cannot be read or written. `what()` is "NAME: reason".
class BadFile : public std::runtime_error {
 public:
  BadFile(const std::string& name, const std::string& reason)
      : std::runtime_error(name + ": " + reason), reason_(reason) {}

  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

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

/// Most bytes that are taken of one file. They are far beyond what is of use, and end inputs that have no end.
inline constexpr std::uint64_t most_of_text = std::uint64_t{256} << 20;
inline constexpr std::uint64_t most_of_recording = std::uint64_t{8} << 30;
inline constexpr std::uint64_t most_of_pipe = std::uint64_t{1} << 30;

/// All of a file, or of standard input for "-". Notes it as read. Throws BadFile, for more than `most` bytes
/// too, and for more than `most_of_pipe` of what is no regular file.
std::string read_file(const std::string& name, std::uint64_t most);

/// "256 MiB", of a whole number of MiB.
std::string mebibytes(std::uint64_t bytes);

/// Notes that the file of this name, or standard input for "-", is read: for code that reads it by other means than
/// read_file. A name that leads to no regular file is not kept.
void note_read(const std::string& name);

/// Names of all files that this program has read.
const std::vector<std::string>& files_read();

/// What identifies a file, whatever its name: its device, and its number there.
using FileId = std::pair<std::uint64_t, std::uint64_t>;

/// Has this program read that file, and is it still there by the name that it was read by?
bool was_read(FileId file);

/// Is the place that `name` leads to, without symbolic links, in the folder or below it? It need not be there yet.
bool is_below(const std::string& folder, const std::string& name);

}  // namespace boxstream::files
