// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/find.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  const Outputs& outputs = subject.scene.outputs;
  if (!outputs.record.empty()) return Call{"/outputs/record/0", outputs.record.front()};
  if (!outputs.view.empty()) return Call{"/outputs/view", outputs.view};
  if (!outputs.trace.empty()) return Call{"/outputs/trace", outputs.trace};
  return std::nullopt;
}

}  // namespace

const Effect recording{"recording", "what happens is written to files",
                       "a writer that looks on after each step, or stands before the broad-phase", called_for};

}  // namespace boxstream::effects
