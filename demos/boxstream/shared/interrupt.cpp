// SPDX-License-Identifier: MIT
#include "boxstream/shared/interrupt.hpp"

#include <csignal>

namespace boxstream::tool {
namespace {

volatile std::sig_atomic_t was_interrupted = 0;
struct sigaction former {};

void take(int) {
  was_interrupted = 1;
  sigaction(SIGINT, &former, nullptr);
}

}  // namespace

InterruptCatcher::InterruptCatcher() {
  was_interrupted = 0;
  struct sigaction action {};
  action.sa_handler = take;
  sigemptyset(&action.sa_mask);
  // What nohup or a shell had ignored stays ignored.
  if (sigaction(SIGINT, nullptr, &former) == 0 && former.sa_handler != SIG_IGN) sigaction(SIGINT, &action, nullptr);
}

InterruptCatcher::~InterruptCatcher() {
  sigaction(SIGINT, &former, nullptr);
}

bool interrupted() {
  return was_interrupted != 0;
}

}  // namespace boxstream::tool
