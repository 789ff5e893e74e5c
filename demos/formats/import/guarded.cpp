// SPDX-License-Identifier: MIT
#include "formats/import/guarded.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>

#include "base/read_file.hpp"
#include "formats/import/file_kind.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::imports {
namespace {

constexpr char finished = '+';
constexpr char refused = '-';
constexpr char refused_by_name = '!';  // the message says already which file
constexpr std::size_t most_reply_bytes = std::size_t{512} << 20;

/// The files that a child has read are known to its parent too: their names come before what `work` returns.
std::string put_files_read(std::size_t since) {
  std::string names;
  for (std::size_t i = since; i < files::files_read().size(); ++i) names += files::files_read()[i] + '\0';
  return names + '\0';
}

/// Takes them out; false if the reader crashed before it wrote them.
bool take_files_read(std::string& reply) {
  std::size_t at = 0;
  for (std::size_t end = reply.find('\0'); end != std::string::npos; end = reply.find('\0', at)) {
    const std::string name = reply.substr(at, end - at);
    at = end + 1;
    if (name.empty()) {
      reply.erase(0, at);
      return true;
    }
    files::note_read(name);
  }
  return false;
}

/// Sanitizers reserve terabytes of addresses, which a limit would count. GCC says so by macros, clang by features.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool can_limit_memory = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool can_limit_memory = false;
#else
constexpr bool can_limit_memory = true;
#endif
#else
constexpr bool can_limit_memory = true;
#endif

void limit(decltype(RLIMIT_CPU) resource, rlim_t most) {
  const rlimit both{most, most};
  setrlimit(resource, &both);
}

rlim_t address_space_in_use() {
  std::ifstream file("/proc/self/statm");
  rlim_t pages = 0;
  file >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

void silence_streams() {
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
}

[[noreturn]] void run_child(int out, const std::function<std::string()>& work, const Allowance& allowance) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  silence_streams();
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, allowance.cpu_seconds);
  if (can_limit_memory) limit(RLIMIT_AS, address_space_in_use() + allowance.memory);
  std::string reply;
  try {
    const std::size_t before = files::files_read().size();
    const std::string result = work();
    reply = finished + put_files_read(before) + result;
  } catch (const scenes::SceneError& error) {
    reply = refused_by_name + std::string(error.what());
  } catch (const std::bad_alloc&) {
    reply = std::string(1, refused) + "needs too much memory";
  } catch (const std::exception& error) {
    reply = refused + std::string(error.what());
  }
  for (std::size_t sent = 0; sent < reply.size();) {
    const ssize_t count = write(out, reply.data() + sent, reply.size() - sent);
    if (count <= 0) break;
    sent += static_cast<std::size_t>(count);
  }
  _exit(0);
}

class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_, O_CLOEXEC) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
  }
  ~Pipe() {
    ::close(ends_[0]);
    close_writer();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reader() const { return ends_[0]; }
  int writer() const { return ends_[1]; }
  void close_writer() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  int ends_[2];
};

/// All that comes before the end of the file; false when time runs out or it is too much.
bool read_all(int in, unsigned seconds, std::string& text) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(seconds);
  char block[65536];
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0 || text.size() > most_reply_bytes) return false;
    pollfd ready{in, POLLIN, 0};
    const int found = poll(&ready, 1, static_cast<int>(left));
    if (found < 0 && errno == EINTR) continue;
    if (found <= 0) return false;
    const ssize_t count = read(in, block, sizeof block);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    text.append(block, static_cast<std::size_t>(count));
  }
}

std::string how_it_ended(int status) {
  if (!WIFSIGNALED(status)) return "the reader gave up on it";
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU || signal == SIGKILL) return "takes too long to read";
  return std::string("the reader crashed on it (") + strsignal(signal) + ")";
}

}  // namespace

Allowance allowance_for(const std::string& path) {
  // Small ones may name large files, and cutting up a robot's meshes takes its time.
  const std::string kind = file_kind(path);
  if (kind == "urdf" || kind == "gltf") return {30, 60, std::size_t{4} << 30};
  const std::uintmax_t bytes = std::filesystem::file_size(path);
  constexpr std::uintmax_t mebibyte = std::uintmax_t{1} << 20;
  Allowance allowance;
  allowance.cpu_seconds = static_cast<unsigned>(2 + std::min<std::uintmax_t>(bytes / mebibyte, 100));
  allowance.memory = static_cast<std::size_t>(256 * mebibyte + std::min(bytes * 64, 4096 * mebibyte));
  return allowance;
}

std::string guarded(const std::string& file, const std::function<std::string()>& work, const Allowance& allowance) {
  Pipe channel;
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
  if (child == 0) run_child(channel.writer(), work, allowance);
  channel.close_writer();
  std::string reply;
  const bool whole = read_all(channel.reader(), allowance.wall_seconds, reply);
  if (!whole) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!whole && reply.size() > most_reply_bytes) fail(file, "too large");
  if (!whole || reply.empty()) fail(file, how_it_ended(status));
  if (reply[0] == refused_by_name) throw scenes::SceneError(reply.substr(1));
  if (reply[0] == refused) fail(file, reply.substr(1));
  reply.erase(0, 1);
  if (!take_files_read(reply)) fail(file, "the reader made no sense of it");
  return reply;
}

}  // namespace boxstream::imports
