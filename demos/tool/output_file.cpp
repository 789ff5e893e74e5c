// SPDX-License-Identifier: MIT
#include "output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "bad_input.hpp"

namespace boxstream::tool {

namespace fs = std::filesystem;

OutputFile::OutputFile(const std::string& path) {
  const auto refuse = [&](const std::string& reason) { throw BadInput(path + ": cannot be written: " + reason); };
  std::error_code error;
  // Renaming onto a symbolic link would replace the link, not the file that it names.
  final_ = fs::weakly_canonical(path, error);
  if (error) refuse(error.message());
  const fs::file_status status = fs::status(final_, error);
  if (fs::is_directory(status)) refuse("is a directory");
  direct_ = fs::exists(status) && !fs::is_regular_file(status);
  if (fs::exists(status) && access(final_.c_str(), W_OK) != 0) refuse(std::strerror(errno));
  if (direct_) {
    written_ = final_.string();
    return;
  }
  written_ = final_.string() + "." + std::to_string(getpid()) + ".part";
  const int file = open(written_.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0666);
  if (file < 0) refuse(std::strerror(errno));
  close(file);
  unlink(written_.c_str());
}

OutputFile::~OutputFile() {
  std::error_code error;
  if (!committed_ && !direct_) fs::remove(written_, error);
}

void OutputFile::commit() {
  if (!direct_) fs::rename(written_, final_);
  committed_ = true;
}

}  // namespace boxstream::tool
