// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace boxstream::files {

/// May an output take the place of a file that was read?
enum class Input { must_stay, may_change };

/// A file that appears whole or not at all: written under another name beside its place, then renamed. It has the mode
/// of the file whose place it takes. Devices and pipes are written straight through, as is standard output, named "-".
class OutputFile {
 public:
  /// Opens the file that is to be renamed, and only if there is none of that name. Throws BadFile for what cannot be
  /// written, for a file that is open as another output, and for one that was read (files::note_read), under any of its
  /// names.
  explicit OutputFile(const std::string& name, Input input = Input::must_stay);
  /// Removes what was written but not committed.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& name() const { return name_; }
  bool is_standard_output() const { return name_ == "-"; }
  std::ostream& stream() { return stream_; }
  /// Puts the file in its place. Throws std::runtime_error if not all could be written, and BadFile if the file whose
  /// place it is to take was read meanwhile.
  void commit();

 private:
  class Buffer;

  void refuse(const std::string& reason) const;
  void open_in_place();
  void open_part();
  void check_was_not_read() const;

  std::string name_;
  Input input_;
  std::filesystem::path place_;  // without symbolic links
  std::string part_;             // empty: written straight through
  int descriptor_ = -1;
  std::unique_ptr<Buffer> buffer_;
  std::ostream stream_{nullptr};
};

/// A whole file at once, as OutputFile.
void write_file(const std::string& name, const std::string& text, Input input = Input::must_stay);

/// From now on SIGHUP, SIGINT and SIGTERM remove what is not committed before they end the program.
void remove_parts_on_signals();

}  // namespace boxstream::files
