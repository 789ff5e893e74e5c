// SPDX-License-Identifier: MIT
#include "out_of_core/temporary_file.hpp"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <random>
#include <system_error>

namespace boxstream::detail {

namespace fs = std::filesystem;

namespace {

/// Made by this call, so that no other program's file is opened.
bool create(const fs::path& name) {
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  errno = 0;
  return std::unique_ptr<std::FILE, Close>(std::fopen(name.string().c_str(), "wbx")) != nullptr;
}

}  // namespace

TemporaryFile::TemporaryFile(const std::string& directory, std::size_t block_bytes)
    : directory_(directory.empty() ? fs::temp_directory_path() : fs::path(directory)), block_bytes_(block_bytes) {
  std::random_device random;
  do {
    name_ = directory_ / ("boxstream-" + std::to_string(random()) + std::to_string(random()) + ".tmp");
  } while (!create(name_) && errno == EEXIST);
  if (errno != 0) fail("cannot be made");
  file_.rdbuf()->pubsetbuf(nullptr, 0);
  file_.open(name_, std::ios::in | std::ios::out | std::ios::binary);
  std::error_code keeps_name;
  fs::remove(name_, keeps_name);
  if (!keeps_name) name_.clear();
  if (!file_) fail("cannot be opened");
}

TemporaryFile::~TemporaryFile() {
  file_.close();
  std::error_code ignored;
  if (!name_.empty()) fs::remove(name_, ignored);
}

TemporaryFile::Block TemporaryFile::write(const char* data, std::size_t bytes) {
  Block block = blocks_;
  if (free_.empty()) {
    ++blocks_;
  } else {
    block = free_.back();
    free_.pop_back();
  }
  go_to(block);
  if (!file_.write(data, static_cast<std::streamsize>(bytes))) fail("cannot be written");
  bytes_written_ += bytes;
  return block;
}

void TemporaryFile::read(Block block, char* data, std::size_t bytes) {
  go_to(block);
  if (!file_.read(data, static_cast<std::streamsize>(bytes))) fail("cannot be read");
  bytes_read_ += bytes;
}

void TemporaryFile::go_to(Block block) {
  errno = 0;
  file_.seekp(static_cast<std::streamoff>(block * block_bytes_));
}

void TemporaryFile::fail(const char* what) const {
  throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(),
                          "boxstream: the temporary file in " + directory_.string() + ' ' + what);
}

}  // namespace boxstream::detail
