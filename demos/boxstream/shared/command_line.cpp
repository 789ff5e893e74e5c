// SPDX-License-Identifier: MIT
#include "boxstream/shared/command_line.hpp"

namespace boxstream::tool {

CommandLine& CommandLine::add_below(const std::string& name, const std::string& about) {
  const auto added = std::make_shared<CommandLine>(about, name, this);
  add_subcommand(added);
  return *added;
}

std::vector<const CommandLine*> CommandLine::below() const {
  std::vector<const CommandLine*> visible;
  for (const CLI::App* const command : get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); }))
    visible.push_back(static_cast<const CommandLine*>(command));
  return visible;
}

std::vector<const CLI::Option*> CommandLine::options() const {
  return get_options([](const CLI::Option* each) { return each->nonpositional(); });
}

std::vector<const CLI::Option*> CommandLine::arguments() const {
  return get_options([](const CLI::Option* each) { return !each->nonpositional(); });
}

std::string CommandLine::whole_name(const char* separator) const {
  const auto* const above = static_cast<const CommandLine*>(get_parent());
  return above == nullptr ? get_name() : above->whole_name(separator) + separator + get_name();
}

std::vector<std::string> CommandLine::words_of(const CLI::Option* option) const {
  const auto found = words_.find(option);
  return found == words_.end() ? std::vector<std::string>{} : found->second();
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

bool takes_files(const CLI::Option& option) {
  return option.get_positional() ? option.get_type_name().empty() : option.get_type_name() == "FILE";
}

}  // namespace boxstream::tool
