// SPDX-License-Identifier: MIT
#include "boxstream/simulate/recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/machine.hpp"
#include "boxstream/shared/print.hpp"
#include "pictures/viewer/page.hpp"
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

}  // namespace

Recordings::Recordings(const SimulateOptions& options)
    : view_name_(options.view),
      trace_name_(options.trace),
      record_every_(options.record_every),
      view_every_(options.view_every) {
  if (!view_name_.empty()) check_ending("--view", view_name_, ".html");
  if (!trace_name_.empty()) check_ending("--trace", trace_name_, ".json");
  if (view_every_ > 0 && view_name_.empty()) throw BadInput("--view-every: goes with --view only");
  if (!view_name_.empty() && !view::has_pages())
    throw BadInput("--view: this boxstream was built without the viewer, which takes node and npm");
  for (const std::string& name : options.record)
    if (name.ends_with(".glb")) films_.push_back(std::make_unique<FilmFile>(name));
  if (record_every_ > 0 && films_.empty()) throw BadInput("--record-every: goes with --record FILE.glb only");
  if (!view_name_.empty()) {
    view_file_.emplace(view_name_);
    view::Recording::Options wanted{0, view_every_};
    const std::size_t worlds = options.compare ? 2 : 1;
    wanted.size /= worlds;
    for (std::size_t i = 0; i < worlds; ++i) pages_.emplace_back(wanted);
  }
  if (!trace_name_.empty()) trace_file_.emplace(trace_name_);
}

void PageMonitor::begin(const scenes::Simulation& simulation, std::uint64_t steps) {
  options_.steps = steps;
  recording_ = std::make_unique<view::Recording>(simulation, options_);
}

std::vector<std::vector<Monitor*>> Recordings::monitors() {
  std::vector<std::vector<Monitor*>> of_worlds(std::max<std::size_t>(1, pages_.size()));
  for (std::size_t i = 0; i < pages_.size(); ++i) of_worlds[i].push_back(&pages_[i]);
  if (!films_.empty()) of_worlds.front().push_back(this);
  return of_worlds;
}

void Recordings::begin(const scenes::Simulation& simulation, std::uint64_t steps) {
  for (const auto& each : films_)
    each->film = std::make_unique<view::Film>(simulation, view::Film::Options{steps, record_every_, versions()});
}

void Recordings::after_step(const scenes::Simulation&) {
  for (const auto& each : films_) each->film->add_step();
}

void Recordings::write_view(const RunResult& result) {
  std::vector<view::PageWorld> worlds;
  for (std::size_t i = 0; i < pages_.size(); ++i) {
    pages_[i].recording().finish();
    worlds.push_back({&pages_[i].recording(), result.worlds[i].broadphase, &result.worlds[i].steps});
  }
  view::write_page(view_file_->stream(), worlds, versions());
}

void Recordings::write(const scenes::Scene& scene, const RunResult& result) {
  for (const auto& each : films_) each->film->write(each->file.stream());
  if (view_file_) write_view(result);
  if (!trace_file_) return;
  std::vector<view::TracedWorld> worlds;
  for (const WorldRun& world : result.worlds) worlds.push_back({world.broadphase, &world.steps});
  view::write_trace(trace_file_->stream(), scene, worlds, versions());
}

void Recordings::commit() {
  for (const auto& each : films_) each->file.commit();
  for (std::optional<files::OutputFile>* const file : {&view_file_, &trace_file_})
    if (*file) (*file)->commit();
}

void Recordings::say_what_is_left_out() {
  for (const auto& each : films_)
    say_if_thinned(each->file.name(), each->film->every(), record_every_, "--record-every");
  if (view_file_) say_if_thinned(view_name_, pages_.front().recording().every(), view_every_, "--view-every");
}

}  // namespace boxstream::tool
