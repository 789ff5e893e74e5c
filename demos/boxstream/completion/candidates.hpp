// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "boxstream/shared/command_line.hpp"

namespace boxstream::tool {

/// What may stand in the place of a word that a user has begun.
struct Candidates {
  enum class Beside { nothing, files, directories };
  struct Word {
    std::string text;
    std::string about{};  ///< may be empty
  };
  std::vector<Word> words;          ///< a last '=' or '/' says that the word goes on
  Beside beside = Beside::nothing;  ///< what fits, too
};

/// `typed`: the words behind the name of the program, up to and with the one that is begun, which may be empty.
Candidates candidates(const CommandLine& all, const std::vector<std::string>& typed);

}  // namespace boxstream::tool
