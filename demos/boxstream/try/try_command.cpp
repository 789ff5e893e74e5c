// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"

namespace boxstream::tool {
namespace {

struct TryOptions {
  bool check = false;
  bool compare = false;
  std::string margin, eager, order;
  std::vector<std::string> program;  // and its arguments
};

/// boxstream-try is a program of its own, because the library is installed with it and without this tool.
int run_try(const TryOptions& options) {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  std::vector<std::string> words{(self.parent_path() / "boxstream-try").string()};
  if (options.check) words.push_back("--check");
  if (options.compare) words.push_back("--compare");
  if (!options.margin.empty()) words.push_back("--margin=" + options.margin);
  if (!options.eager.empty()) words.push_back("--eager=" + options.eager);
  if (!options.order.empty()) words.push_back("--order=" + options.order);
  words.push_back("--");
  words.insert(words.end(), options.program.begin(), options.program.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(pointers[0], pointers.data());
  throw BadInput(words[0] + ": " + std::strerror(errno) + "; ./dev build makes it");
}

Action set_up_try(CommandLine& command) {
  const auto options = std::make_shared<TryOptions>();
  command.add_flag("--check", options->check,
                   "Run the engine's own broad-phases as well, and compare pairs, queries and least distances");
  command.add_flag("--compare", options->compare,
                   "Run the program twice, first on the engine's own, and print both times");
  command.add_option("--margin", options->margin, "Bullet: added to all sides of each box; default: 0")->type_name("M");
  take_words(command,
             add_name(command, "--eager", options->eager, "Bullet: which proxies get pairs before the batch: {}"),
             "proxies", {"ghosts", "all", "none"});
  take_words(command,
             add_name(command, "--order", options->order, "Pairs come in the order of: {}; takes its time, too"),
             "order", {"engine"});
  command.add_option("PROGRAM", options->program, "The program and its arguments, behind --")->required();
  return [options] { return run_try(*options); };
}

}  // namespace

extern const Command try_command{
    "try", "Run a program that is not rebuilt with boxstream in place of its engine's broad-phases", R"(Examples:
  boxstream try --check -- python3 my_dart_script.py
  boxstream try --compare -- ./my_simulation --steps 1000

Prints which engine was found, how many broad-phases were replaced, what they were asked, and how long that took, on
standard error, after the program has ended. --check prints the first difference with its boxes, and exits with 1.

Replaced are btDbvtBroadphase of Bullet, in either precision, and FCL's dynamic trees, its interval tree,
sweep-and-prune and naive managers for doubles, where the program takes them from the shared library. Not replaced are
an engine that is linked statically or compiled into the program, FCL's managers for floats, and btAxisSweep3. Programs
that read the trees themselves (btDbvtBroadphase::m_sets, getTree()) find them empty. docs/try.md says more.)",
    set_up_try};

}  // namespace boxstream::tool
