// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/output_file.hpp"
#include "boxstream/simulate/monitor.hpp"
#include "boxstream/simulate/options.hpp"
#include "boxstream/simulate/simulate.hpp"
#include "pictures/viewer/film.hpp"
#include "pictures/viewer/recording.hpp"

namespace boxstream::tool {

/// Records a world for the page.
class PageMonitor final : public Monitor {
 public:
  explicit PageMonitor(view::Recording::Options options) : options_(options) {}

  void begin(const scenes::Simulation& simulation, std::uint64_t steps) override;
  void after_pairs(const scenes::Simulation&) override {}
  void after_step(const scenes::Simulation&) override { recording_->add_step(); }

  /// There from `begin` on.
  view::Recording& recording() { return *recording_; }

 private:
  view::Recording::Options options_;
  std::unique_ptr<view::Recording> recording_;
};

/// What a run leaves to look at: an animation (--record FILE.glb) of the first world, not of the one it is compared
/// with; a page (--view) and a trace (--trace) of both.
class Recordings final : public Monitor {
 public:
  /// Throws BadInput and files::BadFile for what cannot be recorded, before anything is run.
  explicit Recordings(const SimulateOptions& options);

  /// What is to look on while each world runs.
  std::vector<std::vector<Monitor*>> monitors();
  void begin(const scenes::Simulation& simulation, std::uint64_t steps) override;
  void after_pairs(const scenes::Simulation&) override {}
  void after_step(const scenes::Simulation& simulation) override;

  void write(const scenes::Scene& scene, const RunResult& result);
  void commit();

  /// A remark for each file where steps were left out.
  void say_what_is_left_out();

 private:
  struct FilmFile {
    explicit FilmFile(const std::string& path) : file(path) {}

    files::OutputFile file;
    std::unique_ptr<view::Film> film;
  };

  void write_view(const RunResult& result);

  std::string view_name_, trace_name_;
  std::uint64_t record_every_, view_every_;
  std::vector<std::unique_ptr<FilmFile>> films_;
  std::optional<files::OutputFile> view_file_, trace_file_;
  std::vector<PageMonitor> pages_;  // of each world
};

}  // namespace boxstream::tool
