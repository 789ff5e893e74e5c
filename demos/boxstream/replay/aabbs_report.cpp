// SPDX-License-Identifier: MIT
#include "boxstream/replay/aabbs_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/printable.hpp"
#include "boxstream/shared/json_dump.hpp"
#include "boxstream/shared/machine.hpp"
#include "boxstream/shared/report.hpp"
#include "boxstream/simulate/summary.hpp"
#include "boxstream/simulate/table.hpp"

namespace boxstream::tool {
namespace {

using Json = nlohmann::ordered_json;

Times times_of(const AabbsRun& run, std::size_t broadphase) {
  std::vector<double> times;
  for (const AabbsRun::Frame& frame : run.frames) times.push_back(frame.milliseconds[broadphase]);
  return summarize(std::move(times));
}

}  // namespace

std::string aabbs_text(const AabbsRun& run) {
  std::uint64_t pairs = 0, most = 0;
  for (const AabbsRun::Frame& frame : run.frames) {
    pairs += frame.pairs;
    most = std::max(most, frame.pairs);
  }
  std::string text =
      fmt::format("scene          {} ({})\n", files::printable(run.header.scene), files::printable(run.header.type));
  text += fmt::format("boxes          {} in {} frames\n", grouped(run.header.objects), grouped(run.frames.size()));
  if (run.invalid_boxes > 0) text += fmt::format("invalid        {}\n", grouped(run.invalid_boxes));
  text += fmt::format("pairs          {} in all, {} in one frame at most\n", grouped(pairs), grouped(most));
  text += fmt::format("{:<15}{:>12}{:>12}{:>12}\n", "ms", "median", "min", "total");
  for (std::size_t i = 0; i < run.broadphases.size(); ++i) {
    const Times t = times_of(run, i);
    text += fmt::format("{:<15}{:>12.3f}{:>12.3f}{:>12.1f}\n", run.broadphases[i], t.median_ms, t.min_ms, t.total_ms);
  }
  if (run.pairs_equal)
    text +=
        fmt::format("pairs equal    {}\n", *run.pairs_equal ? "yes, in every frame" : "no: " + run.first_difference);
  return text;
}

std::string aabbs_json(const AabbsRun& run) {
  Json document = report_about({{"file", run.file},
                                {"scene", run.header.scene},
                                {"type", run.header.type},
                                {"objects", run.header.objects},
                                {"steps", run.header.steps},
                                {"invalid_boxes", run.invalid_boxes},
                                {"bullet", bullet_version()}});
  if (run.pairs_equal) {
    document["pairs_equal"] = *run.pairs_equal;
    if (!run.first_difference.empty()) document["first_difference"] = run.first_difference;
  }
  document["broadphases"] = Json::array();
  for (std::size_t i = 0; i < run.broadphases.size(); ++i) {
    const Times t = times_of(run, i);
    document["broadphases"].push_back(
        {{"name", run.broadphases[i]}, {"median_ms", t.median_ms}, {"min_ms", t.min_ms}, {"total_ms", t.total_ms}});
  }
  document["frames"] = Json::array();
  for (const AabbsRun::Frame& frame : run.frames)
    document["frames"].push_back({{"pairs", frame.pairs}, {"ms", frame.milliseconds}});
  return json_dump(document, 1) + "\n";
}

}  // namespace boxstream::tool
