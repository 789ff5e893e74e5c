// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "aabbs/reader.hpp"
#include "aabbs_report.hpp"
#include "bad_input.hpp"
#include "broadphase_name.hpp"
#include "commands.hpp"
#include "files/input_file.hpp"
#include "files/output_file.hpp"
#include "frame_player.hpp"
#include "pair_difference.hpp"
#include "print.hpp"
#include "status_line.hpp"

namespace boxstream::tool {
namespace {

/// The pairs that there are, found with nothing but a sort along one axis.
std::vector<Pair> search(const std::vector<Aabb>& boxes) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (is_valid(boxes[i])) order.push_back(i);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return boxes[a].min[0] < boxes[b].min[0]; });
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].min[0] <= boxes[order[i]].max[0]; ++j)
      if (overlaps(boxes[order[i]], boxes[order[j]]))
        pairs.push_back({std::min(order[i], order[j]), std::max(order[i], order[j])});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Without the near misses that some broad-phases hold.
std::vector<Pair> overlapping(std::vector<Pair> pairs, const std::vector<Aabb>& boxes) {
  const auto apart = [&](Pair pair) {
    return !is_valid(boxes[pair.a]) || !is_valid(boxes[pair.b]) || !overlaps(boxes[pair.a], boxes[pair.b]);
  };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), apart), pairs.end());
  return pairs;
}

std::string describe(Pair pair, const std::vector<Aabb>& boxes) {
  std::string text = fmt::format("objects {} and {}", pair.a, pair.b);
  for (const std::uint32_t i : {pair.a, pair.b})
    text += fmt::format(", box of {}: [{}] to [{}]", i, fmt::join(boxes[i].min, " "), fmt::join(boxes[i].max, " "));
  return text;
}

/// bt32BitAxisSweep3 divides by the sides of the world, sorts by those of boxes and trusts that min comes before max.
void check_world_for_sap(const Aabb& world) {
  for (int d = 0; d < 3; ++d)
    if (!(world.min[d] >= -1e30f && world.max[d] <= 1e30f && world.max[d] - world.min[d] >= 1e-6f))
      throw aabbs::AabbsError(fmt::format("sap needs a world with sides; this one is from {} to {} on the {} axis",
                                          world.min[d], world.max[d], "xyz"[d]));
}

class Run {
 public:
  Run(const AabbsOptions& options, aabbs::Reader& reader) : reader_(reader) {
    run_.file = options.file;
    run_.header = reader.header();
    run_.broadphases = {options.broadphase};
    if (options.compare) run_.broadphases.push_back(*options.compare);
    has_sap_ = std::count(run_.broadphases.begin(), run_.broadphases.end(), "sap") > 0;
    if (has_sap_) check_world_for_sap(run_.header.world);
  }

  AabbsRun go(StatusLine& status) {
    while (run_.first_difference.empty() && reader_.next(boxes_)) {
      play();
      status.step(run_.frames.size(), std::uint64_t{run_.header.steps} + 1, boxes_.size(), run_.frames.back().pairs);
    }
    if (run_.broadphases.size() > 1) run_.pairs_equal = run_.first_difference.empty();
    return std::move(run_);
  }

 private:
  void play() {
    const auto invalid = static_cast<std::uint64_t>(
        std::count_if(boxes_.begin(), boxes_.end(), [](const Aabb& box) { return !is_valid(box); }));
    if (invalid > 0 && has_sap_)
      throw aabbs::AabbsError(fmt::format("sap takes no boxes with a NaN or min > max, of which frame {} has {}",
                                          reader_.frames_read(), invalid));
    run_.invalid_boxes += invalid;
    if (players_.empty())  // not before the first frame is there: a header may claim any number of objects
      for (const std::string& name : run_.broadphases)
        players_.push_back(make_frame_player(name, run_.header.world, boxes_.size()));
    AabbsRun::Frame frame;
    std::vector<std::vector<Pair>> pairs;
    for (const auto& player : players_) {
      frame.milliseconds.push_back(std::chrono::duration<double, std::milli>(player->play(boxes_)).count());
      pairs.push_back(overlapping(player->held(), boxes_));
    }
    frame.pairs = pairs.front().size();
    run_.frames.push_back(std::move(frame));
    if (players_.size() > 1) compare(pairs);
  }

  void compare(const std::vector<std::vector<Pair>>& pairs) {
    const std::vector<Pair> expected = search(boxes_);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto difference = first_difference(expected, pairs[i]);
      if (!difference) continue;
      run_.first_difference =
          fmt::format("frame {}: {} {}, {} {}, search {}; {} {} {}", reader_.frames_read(), run_.broadphases[0],
                      pairs[0].size(), run_.broadphases[1], pairs[1].size(), expected.size(), run_.broadphases[i],
                      difference->in_first ? "lacks" : "has in excess", describe(difference->pair, boxes_));
      return;
    }
  }

  aabbs::Reader& reader_;
  AabbsRun run_;
  bool has_sap_ = false;
  std::vector<Aabb> boxes_;
  std::vector<std::unique_ptr<FramePlayer>> players_;
};

}  // namespace

int aabbs_command(const AabbsOptions& options) {
  check_broadphase(options.broadphase, {"world"});
  if (options.compare) check_broadphase(*options.compare, {"world"});
  const bool from_stdin = options.file == "-";
  files::InputFile file(options.file);
  std::optional<files::OutputFile> json_file;
  if (!options.json.empty()) json_file.emplace(options.json);
  AabbsRun run;
  try {
    aabbs::Reader reader(file.stream());
    StatusLine status;
    run = Run(options, reader).go(status);
  } catch (const aabbs::AabbsError& error) {
    throw BadInput(fmt::format("{}: {}", from_stdin ? "standard input" : options.file, error.what()));
  }
  if (json_file) {
    json_file->stream() << aabbs_json(run);
    json_file->commit();
  }
  if (options.json != "-") print(aabbs_text(run));
  if (!run.first_difference.empty()) throw std::runtime_error("pairs differ: " + run.first_difference);
  return 0;
}

}  // namespace boxstream::tool
