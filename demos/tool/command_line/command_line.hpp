// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>

#include "tool/commands.hpp"

namespace boxstream::tool {

/// What the command that was given does; returns the exit code.
using Chosen = std::function<int()>;

// Each adds a command with its options and its help to the command line. When it is parsed and right, `chosen`, which
// must live as long as `app`, becomes what the command does.
void add_simulate(CLI::App& app, Chosen& chosen);
void add_explain(CLI::App& app, Chosen& chosen);
void add_accuracy(CLI::App& app, Chosen& chosen);
void add_import(CLI::App& app, Chosen& chosen);
void add_mesh(CLI::App& app, Chosen& chosen);
void add_prices(CLI::App& app, Chosen& chosen);
void add_query(CLI::App& app, Chosen& chosen);
void add_replay(CLI::App& app, Chosen& chosen);
void add_list(CLI::App& app, Chosen& chosen);
void add_aabbs(CLI::App& app, Chosen& chosen);
void add_pairs(CLI::App& app, Chosen& chosen);
void add_near(CLI::App& app, Chosen& chosen);
void add_paper(CLI::App& app, Chosen& chosen);

// What commands have in common.
template <class Options>
void choose(CLI::App& command, Chosen& chosen, std::shared_ptr<Options> options, int (*run)(const Options&)) {
  command.callback([&chosen, options, run] { chosen = [options, run] { return run(*options); }; });
}
void add_steps(CLI::App& command, std::optional<std::uint64_t>& steps, const char* text);
void add_scale(CLI::App& command, double& scale, const char* text);
/// Given twice, the last one counts, so that scripts can put their defaults first.
void last_counts(CLI::App& command, std::initializer_list<const char*> options);

}  // namespace boxstream::tool
