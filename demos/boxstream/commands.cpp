// SPDX-License-Identifier: MIT
#include "boxstream/shared/command.hpp"

namespace boxstream::tool {

// Each is defined in the file of its name; a new one is added to both lists. Those of groups that are not built are
// left out.
extern const Command simulate_command, explain_command, accuracy_command, import_command, mesh_command, prices_command,
    query_command, replay_command, list_command, aabbs_command, pairs_command, near_command, paper_command, man_command,
    completion_command, complete_command;

const std::vector<const Command*>& commands() {
  static const std::vector<const Command*> all{
      &simulate_command, &explain_command,
#ifdef BOXSTREAM_TOOL_ACCURACY
      &accuracy_command,
#endif
      &import_command,
#ifdef BOXSTREAM_TOOL_MESH
      &mesh_command,
#endif
      &prices_command,   &query_command,      &replay_command,   &list_command,
      &aabbs_command,    &pairs_command,      &near_command,
#ifdef BOXSTREAM_TOOL_PAPERS
      &paper_command,
#endif
      &man_command,      &completion_command, &complete_command,
  };
  return all;
}

}  // namespace boxstream::tool
