// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace boxstream::tool {

void add_steps(CLI::App& command, std::optional<std::uint64_t>& steps, const char* text) {
  command.add_option("--steps", steps, text)->type_name("N")->check(CLI::Range(1, 10'000'000));
}

void add_scale(CLI::App& command, double& scale, const char* text) {
  command.add_option("--scale", scale, text)->type_name("FACTOR")->check(CLI::Range(1e-4, 1e4));
}

void last_counts(CLI::App& command, std::initializer_list<const char*> options) {
  for (const char* const name : options)
    command.get_option(name)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

}  // namespace boxstream::tool
