// SPDX-License-Identifier: MIT
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/simulate/recordings.hpp"

namespace boxstream::tool {

struct Recordings::Files {};

Recordings::Recordings(const SimulateOptions& options) {
  for (const std::string& name : options.record)
    if (name.ends_with(".glb")) throw BadInput("--record " + name + ": this boxstream was built without the viewer");
  if (!options.view.empty() || !options.trace.empty())
    throw BadInput("--view, --trace: this boxstream was built without the viewer (./dev build has it)");
  if (options.record_every > 0 || options.view_every > 0 || options.view_bodies)
    throw BadInput("--record-every, --view-every, --view-bodies: this boxstream was built without the viewer");
}

Recordings::~Recordings() = default;

std::vector<std::vector<Monitor*>> Recordings::monitors() {
  return {{}};
}

void Recordings::write(const scenes::Scene&, const RunResult&) {}
void Recordings::commit() {}
void Recordings::say_what_is_left_out() {}

}  // namespace boxstream::tool
