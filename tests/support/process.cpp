// SPDX-License-Identifier: MIT
#include "process.hpp"

#include <fcntl.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace boxstream::tool_test {
namespace {

struct Channel {
  int read_end = -1;
  int write_end = -1;
};

Channel make_pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("pipe");
  return {ends[0], ends[1]};
}

Channel make_terminal() {
  Channel c;
  if (openpty(&c.read_end, &c.write_end, nullptr, nullptr, nullptr) != 0) throw std::runtime_error("openpty");
  return c;
}

/// Until the other side closes. A pseudo-terminal reports that as an error, which is an end as well.
std::string read_all(int file) {
  std::string text;
  char buffer[4096];
  for (ssize_t n; (n = read(file, buffer, sizeof buffer)) > 0;) text.append(buffer, static_cast<std::size_t>(n));
  close(file);
  return text;
}

void write_all(int file, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = write(file, text.data() + done, text.size() - done);
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  close(file);
}

void set_limits(const RunOptions& options) {
  const rlimit no_core{0, 0}, time{options.cpu_seconds, options.cpu_seconds + 1};
  setrlimit(RLIMIT_CORE, &no_core);
  if (options.cpu_seconds > 0) setrlimit(RLIMIT_CPU, &time);
  const rlimit memory{rlim_t{options.mebibytes} << 20, rlim_t{options.mebibytes} << 20};
  if (options.mebibytes > 0) setrlimit(RLIMIT_AS, &memory);
}

}  // namespace

Outcome run_program(const std::string& program, const std::vector<std::string>& arguments, const RunOptions& options) {
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const Channel in = make_pipe();
  const Channel out = make_pipe();
  const Channel err = options.terminal ? make_terminal() : make_pipe();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork");
  if (child == 0) {
    setenv("TERM", "xterm", 1);
    dup2(in.read_end, STDIN_FILENO);
    dup2(out.write_end, STDOUT_FILENO);
    dup2(err.write_end, STDERR_FILENO);
    close(in.write_end);
    if (!options.directory.empty() && chdir(options.directory.c_str()) != 0) _exit(126);
    set_limits(options);
    execv(argv[0], argv.data());
    _exit(127);
  }
  close(in.read_end);
  close(out.write_end);
  close(err.write_end);
  Outcome outcome;
  std::thread feed([&] { write_all(in.write_end, options.input); });
  std::thread errors([&] { outcome.err = read_all(err.read_end); });
  std::thread meanwhile([&] {
    if (options.meanwhile) options.meanwhile(child);
  });
  outcome.out = read_all(out.read_end);
  meanwhile.join();
  feed.join();
  errors.join();
  int status = 0;
  waitpid(child, &status, 0);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

std::string lasting_words(const Outcome& outcome) {
  std::istringstream lines(outcome.err);
  std::string words;
  for (std::string line; std::getline(lines, line);)
    // What a scene's settings are too weak for, and what overlaps, is told before the run, as it is by `explain`.
    if (!line.starts_with("boxstream: step ") && !line.starts_with("boxstream: run ") &&
        !line.starts_with("boxstream: hard: ") && !line.starts_with("boxstream: coarse: ") &&
        !line.starts_with("boxstream: unsound: ") &&
        line.find(" deep in each other at the start; ") == std::string::npos &&
        line.find("the machine was busy") == std::string::npos)
      words += line + "\n";
  return words;
}

#ifdef BOXSTREAM_TOOL
std::string tool_program() {
  return BOXSTREAM_TOOL;
}

Outcome run_tool(const std::vector<std::string>& arguments, const RunOptions& options) {
  return run_program(tool_program(), arguments, options);
}
#endif

}  // namespace boxstream::tool_test
