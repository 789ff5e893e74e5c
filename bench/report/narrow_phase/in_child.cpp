// SPDX-License-Identifier: MIT
#include "narrow_phase/in_child.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <memory>
#include <span>
#include <stdexcept>
#include <system_error>

namespace boxstream::report::narrow {
namespace {

using How = Answer::How;

/// Answers that parent and child both see.
class Shared {
 public:
  explicit Shared(std::size_t count) : bytes_(std::max<std::size_t>(count, 1) * sizeof(Answer)) {
    memory_ = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "mmap");
    answers_ = {static_cast<Answer*>(memory_), count};
    std::uninitialized_fill(answers_.begin(), answers_.end(), Answer{});
  }
  ~Shared() { munmap(memory_, bytes_); }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;

  std::span<Answer> answers() const { return answers_; }

 private:
  std::size_t bytes_;
  void* memory_;
  std::span<Answer> answers_;
};

/// The default action of the timer's signal ends the process.
void start_clock(double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - static_cast<double>(timer.it_value.tv_sec)));
  setitimer(ITIMER_VIRTUAL, &timer, nullptr);
}

[[noreturn]] void answer_from(std::size_t first, std::span<Answer> answers, double seconds,
                              const std::function<double(std::size_t)>& ask) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  for (const int number : {SIGABRT, SIGSEGV, SIGVTALRM}) std::signal(number, SIG_DFL);
  if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) dup2(nowhere, STDERR_FILENO);
  for (std::size_t i = first; i < answers.size(); ++i) {
    start_clock(seconds);
    try {
      answers[i].value = ask(i);
      answers[i].how = How::answered;
    } catch (const Unsure&) {
      answers[i].how = How::unsure;
    } catch (const std::exception&) {
      answers[i].how = How::threw;
    }
  }
  _exit(0);
}

How how_it_ended(int status) {
  if (!WIFSIGNALED(status)) return How::crashed;
  if (WTERMSIG(status) == SIGVTALRM) return How::no_end;
  return WTERMSIG(status) == SIGABRT ? How::aborted : How::crashed;
}

}  // namespace

std::vector<Answer> ask_in_child(std::size_t count, double seconds, const std::function<double(std::size_t)>& ask) {
  const Shared shared(count);
  const std::span<Answer> answers = shared.answers();
  for (std::size_t next = 0; next < count;) {
    const pid_t child = fork();
    if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (child == 0) answer_from(next, answers, seconds, ask);
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
      if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waitpid");
    while (next < count && answers[next].how != How::none) ++next;
    if (next < count) answers[next++].how = how_it_ended(status);
  }
  return {answers.begin(), answers.end()};
}

}  // namespace boxstream::report::narrow
