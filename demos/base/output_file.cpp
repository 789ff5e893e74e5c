// SPDX-License-Identifier: MIT
#include "base/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include "base/read_file.hpp"

namespace boxstream::files {
namespace {

namespace fs = std::filesystem;

/// Names of what is not committed yet, where a signal handler finds them.
using Part = std::atomic<const char*>;
std::array<Part, 256> parts;
static_assert(Part::is_always_lock_free, "a signal handler reads it");
std::atomic<pid_t> owner{0};

void remember(const char* part) {
  for (Part& place : parts) {
    const char* none = nullptr;
    if (place.compare_exchange_strong(none, part)) return;
  }
}

void forget(const char* part) {
  for (Part& place : parts)
    if (place.load() == part) place.store(nullptr);
}

extern "C" void remove_parts_and_end(int signal) {
  // A child has inherited names, but no files.
  if (getpid() == owner.load())
    for (const Part& part : parts)
      if (const char* const name = part.load()) unlink(name);
  std::signal(signal, SIG_DFL);
  raise(signal);
}

/// Places of all outputs that are open.
std::vector<fs::path>& open_places() {
  static std::vector<fs::path> places;
  return places;
}

bool status_of(const fs::path& path, struct stat& status) {
  return stat(path.c_str(), &status) == 0;
}

}  // namespace

class OutputFile::Buffer final : public std::streambuf {
 public:
  explicit Buffer(int descriptor) : descriptor_(descriptor) { setp(bytes_.data(), bytes_.data() + bytes_.size()); }

  /// 0, or the first error.
  int error() const { return error_; }

 protected:
  int_type overflow(int_type character) override {
    if (sync() != 0) return traits_type::eof();
    if (traits_type::eq_int_type(character, traits_type::eof())) return traits_type::not_eof(character);
    return sputc(traits_type::to_char_type(character));
  }
  int sync() override {
    const bool good = put(pbase(), static_cast<std::size_t>(pptr() - pbase()));
    setp(bytes_.data(), bytes_.data() + bytes_.size());
    return good ? 0 : -1;
  }
  std::streamsize xsputn(const char* text, std::streamsize count) override {
    if (count < epptr() - pptr()) return std::streambuf::xsputn(text, count);
    return sync() == 0 && put(text, static_cast<std::size_t>(count)) ? count : 0;
  }

 private:
  bool put(const char* text, std::size_t count) {
    while (count > 0 && error_ == 0) {
      const ssize_t done = write(descriptor_, text, count);
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) {
        error_ = done < 0 ? errno : EIO;
        break;
      }
      text += done;
      count -= static_cast<std::size_t>(done);
    }
    return error_ == 0;
  }

  int descriptor_;
  int error_ = 0;
  std::array<char, 65536> bytes_;
};

OutputFile::OutputFile(const std::string& name, Input input) : name_(name), input_(input) {
  struct stat status {};
  if (is_standard_output()) {
    place_ = "-";
    descriptor_ = STDOUT_FILENO;
  } else if (status_of(name_, status) && !S_ISREG(status.st_mode)) {
    place_ = name_;
    open_in_place();
  } else {
    if (!fs::path(name_).has_filename()) refuse("names no file");
    // Renaming onto a symbolic link would replace the link, not the file that it names.
    std::error_code error;
    place_ = fs::absolute(name_, error);
    if (!error) place_ = fs::weakly_canonical(place_, error);
    if (error) refuse(error.message());
  }
  const bool device = descriptor_ > STDERR_FILENO;
  if (!device && std::count(open_places().begin(), open_places().end(), place_) > 0)
    throw BadFile(name_ == "-" ? "standard output" : name_, "named for two outputs");
  if (descriptor_ < 0) open_part();
  open_places().push_back(place_);
  buffer_ = std::make_unique<Buffer>(descriptor_);
  stream_.rdbuf(buffer_.get());
}

OutputFile::~OutputFile() {
  auto& places = open_places();
  places.erase(std::find(places.begin(), places.end(), place_));
  if (descriptor_ > STDERR_FILENO) close(descriptor_);
  if (part_.empty()) return;
  unlink(part_.c_str());
  forget(part_.c_str());
}

void OutputFile::refuse(const std::string& reason) const {
  throw BadFile(name_, "cannot be written: " + reason);
}

void OutputFile::open_in_place() {
  if (fs::is_directory(place_)) refuse("is a directory");
  descriptor_ = open(place_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor_ < 0) refuse(std::strerror(errno));
}

void OutputFile::open_part() {
  struct stat status {};
  const bool replaces = status_of(place_, status);
  if (replaces && access(place_.c_str(), W_OK) != 0) refuse(std::strerror(errno));
  check_was_not_read();
  // A crash may have left one, and numbers of processes come again.
  const std::string stem = place_.string() + "." + std::to_string(getpid());
  for (int attempt = 0; attempt < 100; ++attempt) {
    part_ = stem + (attempt == 0 ? "" : "-" + std::to_string(attempt)) + ".part";
    const mode_t mode = replaces ? status.st_mode & 0600 : 0666;
    // Before it is there: a signal between opening and remembering would leave it.
    remember(part_.c_str());
    descriptor_ = open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, mode);
    const int error = errno;
    if (descriptor_ >= 0) break;
    forget(part_.c_str());
    if (error != EEXIST) refuse(std::strerror(error));
  }
  if (descriptor_ < 0) refuse(std::strerror(EEXIST));
  if (!replaces) return;
  // Only the superuser can give files away; then the mode, which that would narrow.
  if (fchown(descriptor_, status.st_uid, status.st_gid) != 0) errno = 0;
  if (fchmod(descriptor_, status.st_mode & 0777) != 0) errno = 0;
}

void OutputFile::check_was_not_read() const {
  struct stat status {};
  if (input_ == Input::must_stay && status_of(place_, status) && was_read({status.st_dev, status.st_ino}))
    refuse("it is an input too");
}

void OutputFile::commit() {
  const auto fail = [&](int error) {
    throw std::runtime_error((is_standard_output() ? "standard output" : name_) +
                             ": cannot be written: " + std::strerror(error));
  };
  stream_.flush();
  if (buffer_->error() != 0 || !stream_) fail(buffer_->error() != 0 ? buffer_->error() : EIO);
  if (part_.empty()) return;
  check_was_not_read();
  const int descriptor = std::exchange(descriptor_, -1);
  if (close(descriptor) != 0 || rename(part_.c_str(), place_.c_str()) != 0) fail(errno);
  forget(part_.c_str());
  part_.clear();
}

void write_file(const std::string& name, const std::string& text, Input input) {
  OutputFile file(name, input);
  file.stream() << text;
  file.commit();
}

void remove_parts_on_signals() {
  owner = getpid();
  for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGPIPE}) {
    struct sigaction action {
    }, former{};
    action.sa_handler = remove_parts_and_end;
    sigemptyset(&action.sa_mask);
    // What nohup or a shell had ignored stays ignored.
    if (sigaction(signal, nullptr, &former) == 0 && former.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

}  // namespace boxstream::files
