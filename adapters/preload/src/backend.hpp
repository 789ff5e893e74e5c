// SPDX-License-Identifier: MIT
// What stands between the library that is preloaded, which knows no engine, and the one that replaces an engine's
// broad-phases, which is loaded when that engine is first called.
#pragma once

#include "members.hpp"
#include "tally.hpp"

namespace boxstream::preload {

enum class Mode { replace, check, measure };

/// What the preloaded library offers.
struct Front {
  Mode mode;
  EngineTally* tally;
  /// Calls the engine's own function; whatever that calls of the engine is the engine's own, too.
  Word (*own)(unsigned site, const Words& words);
};

/// What a replacement is: one function, which gets the number of the call's row in the lists of members.hpp (counted
/// within its engine), and what that row says. The only name that its library exports is that of `BackendMaker`.
struct Backend {
  Word (*call)(unsigned site, unsigned manager, unsigned member, const Words& words);
};

using BackendMaker = Backend (*)(const Front& front);
constexpr const char* backend_maker = "boxstream_preload_backend";

}  // namespace boxstream::preload
