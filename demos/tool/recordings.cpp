// SPDX-License-Identifier: MIT
#include "recordings.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "bad_input.hpp"
#include "machine.hpp"
#include "view/trace.hpp"

namespace boxstream::tool {
namespace {

std::string versions() {
  return fmt::format("boxstream {}, Bullet {}", boxstream_version(), bullet_version());
}

void check_ending(const char* option, const std::string& name, const std::string& ending) {
  if (std::filesystem::path(name).extension() != ending)
    throw BadInput(fmt::format("{} {}: the file's name must end in {}", option, name, ending));
}

template <class Write>
void write_file(const OutputFile& file, const std::string& name, const Write& write) {
  std::ofstream out(file.path_to_write(), std::ios::binary);
  write(out);
  out.close();
  if (!out) throw std::runtime_error(name + ": cannot be written");
}

std::string remark(const std::string& name, std::uint64_t every, std::uint64_t wanted, const char* option) {
  if (every == 1 || wanted != 0) return {};
  return fmt::format("boxstream: {}: has one in {} steps, to keep it small; {} 1 keeps all\n", name, every, option);
}

}  // namespace

Recordings::Recordings(const SimulateOptions& options, const Claim& claim)
    : view_name_(options.view),
      trace_name_(options.trace),
      record_every_(options.record_every),
      view_every_(options.view_every) {
  if (!view_name_.empty()) check_ending("--view", view_name_, ".html");
  if (!trace_name_.empty()) check_ending("--trace", trace_name_, ".json");
  if (view_every_ > 0 && view_name_.empty()) throw BadInput("--view-every: goes with --view only");
  if (!view_name_.empty() && !view::Page::is_available())
    throw BadInput("--view: this boxstream was built without the viewer, which takes node and npm");
  for (const std::string& name : options.record)
    if (name.ends_with(".glb")) claim(name, films_.emplace_back(std::make_unique<FilmFile>(name))->file);
  if (record_every_ > 0 && films_.empty()) throw BadInput("--record-every: goes with --record FILE.glb only");
  if (!view_name_.empty()) claim(view_name_, view_file_.emplace(view_name_));
  if (!trace_name_.empty()) claim(trace_name_, trace_file_.emplace(trace_name_));
}

void Recordings::begin(const scenes::Simulation& simulation, std::uint64_t steps) {
  for (const auto& each : films_)
    each->film = std::make_unique<view::Film>(simulation, view::Film::Options{steps, record_every_, versions()});
  if (view_file_) page_ = std::make_unique<view::Page>(simulation, view::Page::Options{steps, view_every_, versions()});
}

void Recordings::after_step(const scenes::Simulation&) {
  for (const auto& each : films_) each->film->add_step();
  if (page_) page_->add_step();
}

void Recordings::write(const scenes::Scene& scene, const RunResult& result) {
  for (const auto& each : films_)
    write_file(each->file, each->name, [&](std::ostream& out) { each->film->write(out); });
  if (page_)
    write_file(*view_file_, view_name_, [&](std::ostream& out) { page_->write(out, result.worlds.front().steps); });
  if (!trace_file_) return;
  std::vector<view::TracedWorld> worlds;
  for (const WorldRun& world : result.worlds) worlds.push_back({world.broadphase, &world.steps});
  write_file(*trace_file_, trace_name_, [&](std::ostream& out) { view::write_trace(out, scene, worlds, versions()); });
}

void Recordings::commit() {
  for (const auto& each : films_) each->file.commit();
  for (std::optional<OutputFile>* const file : {&view_file_, &trace_file_})
    if (*file) (*file)->commit();
}

std::string Recordings::remarks() const {
  std::string text;
  for (const auto& each : films_) text += remark(each->name, each->film->every(), record_every_, "--record-every");
  if (page_) text += remark(view_name_, page_->every(), view_every_, "--view-every");
  return text;
}

}  // namespace boxstream::tool
