// SPDX-License-Identifier: MIT
#pragma once

namespace boxstream::tool {

/// While it lives, Ctrl-C ends nothing: `interrupted` is true from then on, so that what was measured can be shown. A
/// second one does what one did before.
class InterruptCatcher {
 public:
  InterruptCatcher();
  ~InterruptCatcher();
  InterruptCatcher(const InterruptCatcher&) = delete;
  InterruptCatcher& operator=(const InterruptCatcher&) = delete;
};

bool interrupted();

}  // namespace boxstream::tool
