// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/executor.hpp>
#include <memory>
#include <stdexcept>
#include <string>

class btBroadphaseInterface;

namespace boxstream::scenes {

struct Bounds;

/// A name that is none of `broadphase_names`; `what()` lists them.
class UnknownBroadphase : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A new broad-phase that owns its pair cache. `sap` (32-bit sweep and prune) takes `bounds` for where
/// objects are expected; `sap` and `simple` hold at most `max_objects`. `executor` is for `boxstream` and `hybrid`
/// (the same by the paper's tree), and must outlive them; null: one thread. Throws UnknownBroadphase.
std::unique_ptr<btBroadphaseInterface> make_broadphase(const std::string& name, const Bounds& bounds,
                                                       std::size_t max_objects, Executor* executor = nullptr);

/// Runs parallel work on that many threads, the calling one included. Throws std::runtime_error if this build has no
/// oneTBB.
std::unique_ptr<Executor> make_executor(int threads);

}  // namespace boxstream::scenes
