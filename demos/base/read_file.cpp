// SPDX-License-Identifier: MIT
#include "base/read_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>

namespace boxstream::files {
namespace {

std::vector<std::string>& all_read() {
  static std::vector<std::string> names;
  return names;
}

/// Standard input stays open.
class Descriptor {
 public:
  explicit Descriptor(const std::string& name)
      : number_(name == "-" ? STDIN_FILENO : open(name.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (number_ > STDIN_FILENO) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }

 private:
  int number_;
};

}  // namespace

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

std::string read_file(const std::string& name, std::uint64_t most_of_file) {
  const std::string called = name == "-" ? "standard input" : name;
  const auto fail = [&](const std::string& reason) { throw BadFile(called, reason); };
  const Descriptor file(name);
  struct stat status {};
  if (file.number() < 0 || fstat(file.number(), &status) != 0) fail(std::strerror(errno));
  note_read(name);
  const auto size = static_cast<std::uint64_t>(std::max<off_t>(0, S_ISREG(status.st_mode) ? status.st_size : 0));
  // Only a regular file says beforehand how long it is.
  const std::uint64_t most = S_ISREG(status.st_mode) ? most_of_file : std::min(most_of_file, most_of_pipe);
  if (size > most) fail("larger than " + mebibytes(most));
  std::string text;
  std::uint64_t length = 0;
  constexpr std::uint64_t block = 65536;
  for (;;) {
    // Room for what the file has and one more byte to see its end by; beyond that in growing steps.
    if (length == text.size()) text.resize(std::max({size + 1, length + length / 2, length + block}));
    const ssize_t count = read(file.number(), text.data() + length, text.size() - length);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(std::strerror(errno));
    if (count == 0) break;
    length += static_cast<std::uint64_t>(count);
    if (length > most) fail("larger than " + mebibytes(most));
  }
  text.resize(length);
  return text;
}

std::string mebibytes(std::uint64_t bytes) {
  return std::to_string(bytes >> 20) + " MiB";
}

void note_read(const std::string& name) {
  const std::string path = name == "-" ? "/proc/self/fd/0" : std::filesystem::absolute(name).string();
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return;
  if (std::find(all_read().begin(), all_read().end(), path) == all_read().end()) all_read().push_back(path);
}

const std::vector<std::string>& files_read() {
  return all_read();
}

bool was_read(FileId file) {
  return std::any_of(all_read().begin(), all_read().end(), [&](const std::string& name) {
    struct stat status {};
    return stat(name.c_str(), &status) == 0 && FileId{status.st_dev, status.st_ino} == file;
  });
}

bool is_below(const std::string& folder, const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path top = fs::canonical(folder, error);
  if (error) return false;
  const fs::path place = fs::weakly_canonical(fs::absolute(name), error);
  if (error) return false;
  return std::mismatch(top.begin(), top.end(), place.begin(), place.end()).first == top.end();
}

}  // namespace boxstream::files
