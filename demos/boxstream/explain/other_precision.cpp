// SPDX-License-Identifier: MIT
#include "boxstream/explain/other_precision.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "accuracy/knob.hpp"
#include "boxstream/shared/scene_files.hpp"

namespace boxstream::tool {
namespace {

namespace fs = std::filesystem;

/// A folder for the length of a job.
class Folder {
 public:
  Folder() : name_((fs::temp_directory_path() / "boxstream-XXXXXX").string()) {
    if (mkdtemp(name_.data()) == nullptr) throw accuracy::BadKnob("no folder for runs in double precision: " + name_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(name_, ignored);
  }

  std::string file(const char* name) const { return name_ + "/" + name; }

 private:
  std::string name_;
};

/// As waitpid has it.
int status_of(std::string program, std::string job, std::string answer) {
  std::string command = "answer";
  char* const words[] = {program.data(), command.data(), job.data(), answer.data(), nullptr};
  pid_t child = 0;
  if (posix_spawn(&child, program.c_str(), nullptr, nullptr, words, environ) != 0)
    throw accuracy::BadKnob(program + " does not start");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

accuracy::Elsewhere other_precision() {
  const fs::path place = executable_directory();
  for (const fs::path& folder : {place, place / ".." / "libexec" / "boxstream"}) {
    const std::string program = (folder / "boxstream-double").string();
    if (access(program.c_str(), X_OK) != 0) continue;
    return [program](const accuracy::Bytes& job) -> accuracy::Bytes {
      const Folder folder_of_job;
      const std::string asked = folder_of_job.file("job"), answer = folder_of_job.file("answer");
      std::ofstream(asked, std::ios::binary)
          .write(reinterpret_cast<const char*>(job.data()), static_cast<std::streamsize>(job.size()));
      const int status = status_of(program, asked, answer);
      // Ctrl-C goes to both programs.
      if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGINT || WTERMSIG(status) == SIGTERM)) return {};
      if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw accuracy::BadKnob("a run in double precision failed, with a complaint of its own");
      std::ifstream file(answer, std::ios::binary);
      return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    };
  }
  return nullptr;
}

}  // namespace boxstream::tool
