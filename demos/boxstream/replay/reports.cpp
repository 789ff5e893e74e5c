// SPDX-License-Identifier: MIT
#include "boxstream/replay/reports.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "base/words.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/report.hpp"
#include "boxstream/simulate/summary.hpp"
#include "formats/record/op.hpp"

namespace boxstream::tool {
namespace {

using Json = nlohmann::ordered_json;

Times times_of(const AabbsRun& run, std::size_t broadphase) {
  std::vector<double> times;
  for (const AabbsRun::Frame& frame : run.frames) times.push_back(frame.milliseconds[broadphase]);
  return summarize(std::move(times));
}

using Json = nlohmann::ordered_json;

Json difference_json(const record::Difference& difference) {
  Json counts;
  for (const auto& [party, count] : difference.counts) counts[party] = count;
  Json json{{"batch", difference.batch},
            {"box_query", difference.query},
            {"counts", std::move(counts)},
            {"who", difference.party},
            {"kind", difference.missing ? "missing" : "extra"},
            {"proxies", difference.proxies},
            {"boxes", Json::array()}};
  // As text: JSON has no infinite numbers.
  for (const Aabb64& box : difference.boxes) {
    Json bounds = Json::array();
    for (const double x : box.min) bounds.push_back(fmt::format("{}", x));
    for (const double x : box.max) bounds.push_back(fmt::format("{}", x));
    json["boxes"].push_back(std::move(bounds));
  }
  return json;
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

std::string replay_text(const ReplayRun& run) {
  const record::Census& c = run.census;
  std::string text = fmt::format("recording      {}\n", files::printable(run.header.about));
  text += fmt::format("calls          {} proxies, {} at once at most; {} moves, {} destroyed, {} refiltered\n",
                      grouped(c.created), grouped(c.most_alive), grouped(c.moves), grouped(c.destroyed),
                      grouped(c.refilters));
  text += fmt::format("               {} batches, {} box queries, {} ray queries\n", grouped(c.batches),
                      grouped(c.box_queries), grouped(c.ray_queries));
  for (std::size_t i = 0; i < run.broadphases.size(); ++i)
    text += fmt::format("{:<15}{:.1f} ms\n", run.broadphases[i], run.result.milliseconds[i]);
  if (const auto& difference = run.result.difference)
    text += fmt::format("pairs equal    no: {}\n", record::describe(*difference, run.header.scalar));
  else
    text += fmt::format("pairs equal    yes, in every batch ({} batches, {} pairs)\n", grouped(run.result.batches),
                        grouped(run.result.pairs));
  return text;
}

std::string replay_json(const ReplayRun& run) {
  const record::Census& c = run.census;
  Json document = report_about({{"file", run.file},
                                {"about", files::printable(run.header.about)},
                                {"precision", run.header.scalar == record::Scalar::float32 ? "float" : "double"},
                                {"bullet", bullet_version()}});
  document["calls"] = {{"created", c.created},
                       {"most_alive", c.most_alive},
                       {"moves", c.moves},
                       {"destroyed", c.destroyed},
                       {"refilters", c.refilters},
                       {"batches", c.batches},
                       {"box_queries", c.box_queries},
                       {"ray_queries", c.ray_queries},
                       {"resets", c.resets},
                       {"invalid_boxes", c.invalid_boxes}};
  document["broadphases"] = Json::array();
  for (std::size_t i = 0; i < run.broadphases.size(); ++i)
    document["broadphases"].push_back({{"name", run.broadphases[i]}, {"total_ms", run.result.milliseconds[i]}});
  document["batches"] = run.result.batches;
  document["pairs"] = run.result.pairs;
  document["pairs_equal"] = !run.result.difference;
  if (run.result.difference) document["first_difference"] = difference_json(*run.result.difference);
  return json_dump(document, 1) + "\n";
}

}  // namespace boxstream::tool
