// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include <boxstream/executor.hpp>

namespace boxstream::scenes {

/// Runs parallel work on that many threads, the calling one included. Throws std::runtime_error if this build has no
/// oneTBB.
std::unique_ptr<Executor> make_executor(int threads);

}  // namespace boxstream::scenes
