// SPDX-License-Identifier: MIT
#include "boxstream/shared/interrupt.hpp"

#include <csignal>

namespace boxstream::tool {
namespace {

volatile std::sig_atomic_t was_interrupted = 0;

void take(int) {
  was_interrupted = 1;
  std::signal(SIGINT, SIG_DFL);
}

}  // namespace

InterruptCatcher::InterruptCatcher() {
  was_interrupted = 0;
  std::signal(SIGINT, take);
}

InterruptCatcher::~InterruptCatcher() {
  std::signal(SIGINT, SIG_DFL);
}

bool interrupted() {
  return was_interrupted != 0;
}

}  // namespace boxstream::tool
