// SPDX-License-Identifier: MIT
// boxstream-try: runs a program that is not rebuilt with boxstream in place of its engine's broad-phases.
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "program_file.hpp"
#include "try_report.hpp"

namespace {

namespace preload = boxstream::preload;
namespace fs = std::filesystem;

constexpr int exit_differs = 1;
constexpr int exit_bad_input = 2;

constexpr const char* help =
    R"(Run a program with boxstream in place of the broad-phases of its Bullet or FCL, without rebuilding it
Usage: boxstream try [OPTIONS] -- PROGRAM [ARGUMENTS]

Options:
  -h,--help         Print this help message and exit
  --check           Run the engine's own broad-phases as well, and compare: the pairs of each batch, those of each query,
                    least distances. The first difference is printed with its boxes
  --compare         Run the program twice, first on the engine's own, and print the times of both
  --margin M        Bullet: added to all sides of each box, in world units; default: 0
  --eager WHICH     Bullet: which proxies get pairs before the batch: ghosts (default), all, none
  --order engine    Pairs come in the order of the engine's own; takes its time, too

Prints which engine was found, how many broad-phases were replaced, what they were asked, and how long that took, on
standard error, after the program has ended. Exit status: 1 if --check found a difference, 2 for wrong arguments, else
that of the program.

Replaced are btDbvtBroadphase of Bullet, in either precision, and FCL's dynamic trees, its interval tree, sweep-and-prune
and naive managers for doubles, where the program takes them from the shared library. Not replaced are: an engine that is
linked statically or compiled into the program, FCL's managers for floats, btAxisSweep3. Programs that read the trees
themselves (btDbvtBroadphase::m_sets, getTree()) find them empty.

Examples:
  boxstream try --check -- python3 my_dart_script.py
  boxstream try --compare -- ./my_simulation --steps 1000
)";

[[noreturn]] void refuse(const std::string& text) {
  std::fprintf(stderr, "boxstream: %s\n", text.c_str());
  std::exit(exit_bad_input);
}

struct Arguments {
  bool check = false;
  bool compare = false;
  std::vector<char*> program;
};

bool is_one_of(const std::string& word, std::initializer_list<const char*> words) {
  for (const char* known : words) {
    if (word == known) return true;
  }
  return false;
}

Arguments read_arguments(int argc, char** argv) {
  Arguments arguments;
  int i = 1;
  for (; i < argc && argv[i][0] == '-' && std::strcmp(argv[i], "--") != 0; ++i) {
    std::string option = argv[i];
    if (option == "-h" || option == "--help") {
      std::fputs(help, stdout);
      std::exit(0);
    }
    if (option == "--check") {
      arguments.check = true;
      continue;
    }
    if (option == "--compare") {
      arguments.compare = true;
      continue;
    }
    std::string value;
    if (const auto at = option.find('='); at != std::string::npos) {
      value = option.substr(at + 1);
      option.resize(at);
    } else if (i + 1 < argc) {
      value = argv[++i];
    }
    if (option == "--check" || option == "--compare") {
      refuse(option + " takes no value: " + value);
    } else if (option == "--margin") {
      char* end = nullptr;
      const double margin = std::strtod(value.c_str(), &end);
      if (value.empty() || *end || !(margin >= 0 && margin < 1e30))
        refuse("--margin takes a number, 0 or more: " + value);
      setenv("BOXSTREAM_TRY_MARGIN", value.c_str(), 1);
    } else if (option == "--eager") {
      if (!is_one_of(value, {"ghosts", "all", "none"})) refuse("--eager takes ghosts, all or none: " + value);
      setenv("BOXSTREAM_TRY_EAGER", value.c_str(), 1);
    } else if (option == "--order") {
      if (value != "engine") refuse("--order takes engine: " + value);
      setenv("BOXSTREAM_TRY_ORDER", value.c_str(), 1);
    } else {
      refuse("no such option: " + option + " (boxstream try --help)");
    }
  }
  if (i < argc && std::strcmp(argv[i], "--") == 0) ++i;
  arguments.program.assign(argv + i, argv + argc);
  if (arguments.program.empty()) refuse("no program is named: boxstream try [OPTIONS] -- PROGRAM [ARGUMENTS]");
  if (arguments.check && arguments.compare)
    refuse("--check takes the time of both broad-phases; --compare goes without it");
  return arguments;
}

/// The library that is preloaded, beside this program as in a build or in an installation.
std::string library_file() {
  const fs::path own = fs::read_symlink("/proc/self/exe").parent_path().parent_path();
  for (const char* folder : {"lib", BOXSTREAM_PRELOAD_LIBDIR}) {
    const fs::path file = own / folder / "boxstream" / "libboxstream-preload.so";
    if (fs::exists(file)) return file.string();
  }
  refuse("libboxstream-preload.so is missing: it is installed with boxstream-try");
}

class Folder {
 public:
  Folder() {
    std::error_code none;
    const fs::path place = fs::temp_directory_path(none);
    if (none)
      refuse(std::string("no folder for temporary files: ") + (std::getenv("TMPDIR") ? std::getenv("TMPDIR") : "/tmp"));
    std::string pattern = (place / "boxstream-try-XXXXXX").string();
    if (!mkdtemp(pattern.data())) refuse("cannot make a folder in " + place.string());
    path_ = pattern;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

preload::RunReport run(const Arguments& arguments, const char* mode, const Folder& folder) {
  std::vector<char*> words = arguments.program;
  words.push_back(nullptr);
  const std::string library = library_file();
  const auto begin = std::chrono::steady_clock::now();
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) refuse("cannot start a process");
  if (child == 0) {
    const char* const before = std::getenv("LD_PRELOAD");
    const std::string preloaded = before && *before ? library + ":" + before : library;
    setenv("LD_PRELOAD", preloaded.c_str(), 1);
    setenv("BOXSTREAM_TRY_MODE", mode, 1);
    setenv("BOXSTREAM_TRY_TALLIES", folder.path().c_str(), 1);
    execvp(words[0], words.data());
    std::fprintf(stderr, "boxstream: cannot run %s: %s\n", words[0], std::strerror(errno));
    _exit(127);
  }
  // An interrupt is for the program; what it did until then is told.
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGQUIT, SIG_IGN);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {preload::read_tallies(folder.path()), took.count(), code};
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = read_arguments(argc, argv);
  const std::string name = arguments.program[0];
  const std::string file = preload::find_program(name);
  if (file.empty()) refuse(preload::why_not_found(name));
  if (const std::string why = preload::why_not_preloaded(file); !why.empty()) refuse(name + " " + why);
  const Folder folder_of_own, folder;
  preload::RunReport own;
  if (arguments.compare) {
    own = run(arguments, "measure", folder_of_own);
    if (own.exit_code != 0) {
      std::fprintf(stderr, "boxstream: %s ended with status %d on the engine's own: nothing is compared\n",
                   name.c_str(), own.exit_code);
      return own.exit_code;
    }
  }
  const preload::RunReport ours = run(arguments, arguments.check ? "check" : "replace", folder);
  const bool differs = preload::print_report(ours, arguments.check);
  if (arguments.compare) preload::print_comparison(own, ours);
  return differs ? exit_differs : ours.exit_code;
}
