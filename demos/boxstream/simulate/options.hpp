// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace boxstream::tool {

/// Of the command simulate.
struct SimulateOptions {
  std::string scene;
  std::string solver;                     // empty: as the scene says
  std::string precision;                  // the same
  std::optional<std::string> broadphase;  // none: as the scene says
  std::optional<std::string> compare;
  std::optional<std::uint64_t> steps;  // none: as the scene says
  double scale = 1;
  std::string json;                          // empty: none; "-": standard output, in place of the table
  std::string picture;                       // empty: none
  std::string log;                           // empty: none
  std::vector<std::string> record;           // by extension
  std::string csv;                           // empty: none
  std::string states;                        // empty: none
  std::string events;                        // the same
  std::string view;                          // empty: none
  std::string trace;                         // empty: none
  std::uint64_t record_every = 0;            // 0: as the size of the file allows
  std::uint64_t view_every = 0;              // 0: as the size of the file allows
  std::optional<std::uint64_t> view_bodies;  // none: as many as browsers show in seconds
  bool all_effects = false;                  // also what the scene does not call for
  bool only_called = false;                  // says the default aloud
  bool strict = false;                       // warnings end it before it runs
  bool outputs_anywhere = false;             // the scene may name outputs outside of the current folder
};

}  // namespace boxstream::tool
