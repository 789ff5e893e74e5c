// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "boxstream/simulate/simulate.hpp"

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

/// What a run leaves to look at: an animation (--record FILE.glb) of the first world, not of the one it is compared
/// with; a page (--view) and a trace (--trace) of both.
class Recordings {
 public:
  /// Throws BadInput and files::BadFile for what cannot be recorded, before anything is run.
  explicit Recordings(const SimulateOptions& options);
  ~Recordings();

  /// What is to look on while each world runs.
  std::vector<std::vector<Monitor*>> monitors();

  void write(const scenes::Scene& scene, const RunResult& result);
  void commit();

  /// A remark for each file where steps or objects were left out.
  void say_what_is_left_out();

 private:
  struct Files;
  std::unique_ptr<Files> files_;
};

}  // namespace boxstream::tool
