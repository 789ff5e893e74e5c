// SPDX-License-Identifier: MIT
#include "pictures/viewer/page.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "pictures/viewer/deflate.hpp"
#include "pictures/viewer/description.hpp"
#include "pictures/viewer/shell.hpp"

namespace boxstream::view {
namespace {

float diagonal(const Snapshot::Box& box) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) sum += std::pow(static_cast<double>(box.max[d]) - box.min[d], 2);
  return static_cast<float>(std::sqrt(sum));
}

/// A power of two that is fine for the smallest thing that moves, and for the whole scene as well; yet never so fine
/// that what leaves the scene would soon be out of reach.
float unit_of(const scenes::Bounds& bounds, const Snapshot& snapshot) {
  double extent = 0;
  for (std::size_t d = 0; d < 3; ++d) extent = std::max(extent, bounds.max[d] - bounds.min[d]);
  double unit = std::ldexp(extent, -17);
  for (std::size_t i = 0; i < snapshot.boxes.size(); ++i)
    if (snapshot.moods[i] != Mood::fixed && snapshot.moods[i] != Mood::gone)
      unit = std::min(unit, std::ldexp(static_cast<double>(diagonal(snapshot.boxes[i])), -7));
  unit = std::max(unit, std::ldexp(extent, -24));
  return unit > 0 && std::isfinite(unit) ? std::ldexp(1.0F, std::ilogb(unit)) : 1.0F / 1024;
}

std::uint64_t interval(const Page::Options& options, const Snapshot& first) {
  if (options.every > 0) return options.every;
  const std::size_t expected = expected_frame_size(first.poses.size(), first.nodes.size()) * options.steps;
  return std::max<std::uint64_t>(1, (expected + Page::page_size - 1) / Page::page_size);
}

}  // namespace

bool Page::is_available() {
  return !shell().empty();
}

Page::Page(const scenes::Simulation& simulation, const Options& options)
    : simulation_(simulation),
      versions_(options.versions),
      model_(model_of(simulation)),
      unit_((snapshot_.read(simulation, model_), unit_of(simulation.scene().world.bounds, snapshot_))),
      every_(interval(options, snapshot_)),
      encoder_(unit_) {
  add_frame(0);
}

void Page::add_frame(std::uint64_t step) {
  frame_steps_.push_back(step);
  encoder_.add(snapshot_);
  if (encoder_.is_full()) end_block();
}

void Page::end_block() {
  blocks_.push_back(base64(deflated(encoder_.take_block())));
}

void Page::add_step() {
  if (++steps_ % every_ != 0) return;
  snapshot_.read(simulation_, model_);
  add_frame(steps_);
}

void Page::write(std::ostream& out, const std::vector<scenes::StepResult>& results) {
  const std::string_view page = shell();
  const std::size_t mark = page.find(shell_mark);
  if (mark == std::string_view::npos) return;
  if (!encoder_.is_empty()) end_block();
  const std::string description = describe({simulation_.scene(), simulation_.broadphase_name(), versions_, model_,
                                            unit_, frame_steps_, results, blocks_.size()});
  out << page.substr(0, mark);
  const auto put = [&](const std::string& id, std::string_view text) {
    out << "<script type=\"text/plain\" id=\"" << id << "\">" << text << "</script>\n";
  };
  put("run", base64(deflated(description)));
  for (std::size_t i = 0; i < blocks_.size(); ++i) put("frames-" + std::to_string(i), blocks_[i]);
  out << page.substr(mark + shell_mark.size());
}

}  // namespace boxstream::view
