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
#include "pictures/viewer/page.hpp"

namespace boxstream::tool {

/// What a run leaves to look at: an animation (--record FILE.glb), a page (--view), a trace (--trace). The first two
/// show the first world, not the one it is compared with.
class Recordings final : public Monitor {
 public:
  /// Throws BadInput and files::BadFile for what cannot be recorded, before anything is run.
  explicit Recordings(const SimulateOptions& options);

  /// Whether a recording takes each step.
  bool is_active() const { return !films_.empty() || view_file_; }
  void begin(const scenes::Simulation& simulation, std::uint64_t steps) override;
  void after_pairs(const scenes::Simulation&) override {}
  void after_step(const scenes::Simulation& simulation) override;

  void write(const scenes::Scene& scene, const RunResult& result);
  void commit();

  /// A remark for each file where steps were left out.
  void say_what_is_left_out() const;

 private:
  struct FilmFile {
    explicit FilmFile(const std::string& path) : file(path) {}

    files::OutputFile file;
    std::unique_ptr<view::Film> film;
  };

  std::string view_name_, trace_name_;
  std::uint64_t record_every_, view_every_;
  std::vector<std::unique_ptr<FilmFile>> films_;
  std::optional<files::OutputFile> view_file_, trace_file_;
  std::unique_ptr<view::Page> page_;
};

}  // namespace boxstream::tool
