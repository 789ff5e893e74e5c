// SPDX-License-Identifier: MIT
#include "boxstream/simulate/recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>

#include "base/output_file.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/report.hpp"
#include "pictures/viewer/film.hpp"
#include "pictures/viewer/page.hpp"
#include "pictures/viewer/recording.hpp"
#include "pictures/viewer/trace.hpp"

namespace boxstream::tool {
namespace {

void check_ending(const char* option, const std::string& name, const std::string& ending) {
  if (std::filesystem::path(name).extension() != ending)
    throw BadInput(fmt::format("{} {}: the file's name must end in {}", option, name, ending));
}

void say_if_thinned(const std::string& name, std::uint64_t every, std::uint64_t wanted, const char* option) {
  if (every == 1 || wanted != 0) return;
  remark(fmt::format("{}: has one in {} steps, to keep it small; {} 1 keeps all", name, every, option));
}

void say_if_sampled(const std::string& name, const view::Kept& kept) {
  if (kept.is_all()) return;
  remark(fmt::format("{}: shows {} of {} objects, so that it opens at once; --view-bodies {} shows all", name,
                     grouped(kept.objects.size()), grouped(kept.in_world), kept.in_world));
}

/// Records a world for the page.
class PageMonitor final : public Monitor {
 public:
  /// `first`: whose objects it shows, if another world of the page was there before.
  PageMonitor(view::Recording::Options options, const PageMonitor* first) : options_(options), first_(first) {}

  void begin(const scenes::Simulation& simulation, std::uint64_t steps) override {
    options_.steps = steps;
    recording_ = first_ ? std::make_unique<view::Recording>(simulation, options_, first_->recording_->model().kept)
                        : std::make_unique<view::Recording>(simulation, options_);
  }
  void after_pairs(const scenes::Simulation&) override {}
  void after_step(const scenes::Simulation&) override { recording_->add_step(); }

  /// There from `begin` on.
  view::Recording& recording() { return *recording_; }

 private:
  view::Recording::Options options_;
  const PageMonitor* first_;
  std::unique_ptr<view::Recording> recording_;
};

/// Records a world as an animation.
class FilmMonitor final : public Monitor {
 public:
  FilmMonitor(const std::string& path, std::uint64_t every) : file_(path), every_(every) {}

  void begin(const scenes::Simulation& simulation, std::uint64_t steps) override {
    film_ = std::make_unique<view::Film>(simulation, view::Film::Options{steps, every_, versions()});
  }
  void after_pairs(const scenes::Simulation&) override {}
  void after_step(const scenes::Simulation&) override { film_->add_step(); }

  void write() { film_->write(file_.stream()); }
  void commit() { file_.commit(); }
  void say_what_is_left_out() const { say_if_thinned(file_.name(), film_->every(), every_, "--record-every"); }

 private:
  files::OutputFile file_;
  std::uint64_t every_;
  std::unique_ptr<view::Film> film_;
};

}  // namespace

struct Recordings::Files {
  std::uint64_t view_every;
  bool view_bodies;  // said how many
  std::vector<std::unique_ptr<FilmMonitor>> films;
  std::optional<files::OutputFile> view, trace;
  std::deque<PageMonitor> pages = {};  // of each world
};

Recordings::Recordings(const SimulateOptions& options)
    : files_(new Files{options.view_every, options.view_bodies.has_value(), {}, {}, {}}) {
  const bool has_view = !options.view.empty();
  if (has_view) check_ending("--view", options.view, ".html");
  if (!options.trace.empty()) check_ending("--trace", options.trace, ".json");
  if (options.view_every > 0 && !has_view) throw BadInput("--view-every: goes with --view only");
  if (options.view_bodies && !has_view) throw BadInput("--view-bodies: goes with --view only");
  if (has_view && !view::has_pages())
    throw BadInput("--view: this boxstream was built without the viewer, which takes node and npm");
  for (const std::string& name : options.record)
    if (name.ends_with(".glb")) files_->films.push_back(std::make_unique<FilmMonitor>(name, options.record_every));
  if (options.record_every > 0 && files_->films.empty())
    throw BadInput("--record-every: goes with --record FILE.glb only");
  if (has_view) {
    files_->view.emplace(options.view);
    view::Recording::Options wanted{0, options.view_every};
    const std::size_t worlds = options.compare ? 2 : 1;
    wanted.size /= worlds;
    if (options.view_bodies) wanted.bodies = *options.view_bodies;
    for (std::size_t i = 0; i < worlds; ++i)
      files_->pages.emplace_back(wanted, i == 0 ? nullptr : &files_->pages.front());
  }
  if (!options.trace.empty()) files_->trace.emplace(options.trace);
}

Recordings::~Recordings() = default;

std::vector<std::vector<Monitor*>> Recordings::monitors() {
  std::vector<std::vector<Monitor*>> of_worlds(std::max<std::size_t>(1, files_->pages.size()));
  for (std::size_t i = 0; i < files_->pages.size(); ++i) of_worlds[i].push_back(&files_->pages[i]);
  for (const auto& film : files_->films) of_worlds.front().push_back(film.get());
  return of_worlds;
}

void Recordings::write(const scenes::Scene& scene, const RunResult& result) {
  for (const auto& film : files_->films) film->write();
  if (files_->view) {
    std::vector<view::PageWorld> worlds;
    for (std::size_t i = 0; i < files_->pages.size(); ++i) {
      view::Recording& recording = files_->pages[i].recording();
      recording.finish();
      worlds.push_back({&recording, result.worlds[i].broadphase, &result.worlds[i].steps});
    }
    view::write_page(files_->view->stream(), worlds, versions());
  }
  if (files_->trace) {
    std::vector<view::TracedWorld> worlds;
    for (const WorldRun& world : result.worlds) worlds.push_back({world.broadphase, &world.steps});
    view::write_trace(files_->trace->stream(), scene, worlds, versions());
  }
}

void Recordings::commit() {
  for (const auto& film : files_->films) film->commit();
  for (std::optional<files::OutputFile>* const file : {&files_->view, &files_->trace})
    if (*file) (*file)->commit();
}

void Recordings::say_what_is_left_out() {
  for (const auto& film : files_->films) film->say_what_is_left_out();
  if (!files_->view) return;
  const view::Recording& recording = files_->pages.front().recording();
  say_if_thinned(files_->view->name(), recording.every(), files_->view_every, "--view-every");
  if (!files_->view_bodies) say_if_sampled(files_->view->name(), recording.model().kept);
}

}  // namespace boxstream::tool
