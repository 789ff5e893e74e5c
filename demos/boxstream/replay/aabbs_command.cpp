// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <boxstream/detector.hpp>
#include <filesystem>
#include <stdexcept>

#include "base/read_file.hpp"
#include "base/sorted_sweep.hpp"
#include "boxstream/replay/frame_player.hpp"
#include "boxstream/replay/large_frames.hpp"
#include "boxstream/replay/reports.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/output_files.hpp"
#include "boxstream/shared/print.hpp"
#include "formats/aabbs/reader.hpp"

namespace boxstream::tool {
namespace {

struct AabbsOptions {
  std::string file;                  // "-": standard input
  std::string broadphase = "world";  // boxstream's World, or one of those of `simulate`
  std::optional<std::string> compare;
  std::uint64_t max_pairs = record::usual_most_pairs;  // of a frame
  std::string json;                                    // empty: none; "-": standard output, in place of the text
  std::optional<std::uint64_t> memory;                 // bytes; frames may be larger
  std::string directory;                               // of the temporary file
  std::string pairs;                                   // as json
};

/// Before a broad-phase is asked to hold them.
void check_pairs(Detector& detector, const std::vector<Aabb>& boxes, std::uint64_t most, std::uint64_t frame) {
  std::uint64_t pairs = 0;
  detector.stream_pairs(boxes, [&](Span<const Pair> found) { return (pairs += found.size()) <= most; });
  if (pairs > most)
    throw aabbs::AabbsError(
        fmt::format("frame {}: more than {} pairs (--max-pairs allows more, --memory finds any number)", frame, most));
}

/// The pairs that there are.
std::vector<Pair> search(const std::vector<Aabb>& boxes) {
  std::vector<std::uint32_t> valid;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (is_valid(boxes[i])) valid.push_back(i);
  std::vector<Pair> pairs;
  sorted_sweep(
      valid, 0, [&](std::uint32_t i) -> const Aabb& { return boxes[i]; }, [&](Pair pair) { pairs.push_back(pair); });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Without the near misses that some broad-phases hold.
std::vector<Pair> overlapping(std::vector<Pair> pairs, const std::vector<Aabb>& boxes) {
  const auto disjoint = [&](Pair pair) {
    return !is_valid(boxes[pair.a]) || !is_valid(boxes[pair.b]) || !overlaps(boxes[pair.a], boxes[pair.b]);
  };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), disjoint), pairs.end());
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
  Run(const AabbsOptions& options, aabbs::Reader& reader) : reader_(reader), max_pairs_(options.max_pairs) {
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
    check_pairs(detector_, boxes_, max_pairs_, reader_.frames_read());
    const auto invalid = static_cast<std::uint64_t>(
        std::count_if(boxes_.begin(), boxes_.end(), [](const Aabb& box) { return !is_valid(box); }));
    if (invalid > 0 && has_sap_)
      throw aabbs::AabbsError(fmt::format("sap takes no boxes with a NaN or min > max, of which frame {} has {}",
                                          reader_.frames_read(), invalid));
    run_.invalid_boxes += invalid;
    if (players_.empty())  // not before the first frame is there: a header may claim any number of objects
      for (const std::string& name : run_.broadphases)
        players_.push_back(make_frame_player(name, run_.header.world, boxes_.size(), max_pairs_));
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
  std::uint64_t max_pairs_;
  Detector detector_;
  AabbsRun run_;
  bool has_sap_ = false;
  std::vector<Aabb> boxes_;
  std::vector<std::unique_ptr<FramePlayer>> players_;
};

int run_large(const AabbsOptions& options) {
  if (options.file == "-") throw BadInput("standard input: --memory reads frames more than once, which takes a file");
  if (!options.directory.empty() && !std::filesystem::is_directory(options.directory))
    throw BadInput(fmt::format("--temporary {}: no such folder", options.directory));
  files::InputFile file(options.file);
  OutputFiles files;
  // Pairs that cannot be written end the search, and are the first that is said of it then.
  std::ostream *const pairs = files.add(options.pairs), *const json = files.add(options.json);
  LargeFrames result;
  try {
    StatusLine status;
    result = find_in_large_frames(file.stream(), options.file, {*options.memory, options.directory}, pairs, status);
  } catch (const aabbs::AabbsError& error) {
    throw BadInput(fmt::format("{}: {}", options.file, error.what()));
  }
  if (json != nullptr) *json << large_frames_json(result);
  files.commit();
  if (options.json != "-" && options.pairs != "-") print(large_frames_text(result));
  return 0;
}

int run_aabbs(const AabbsOptions& options) {
  if (options.memory) return run_large(options);
  const bool from_stdin = options.file == "-";
  files::InputFile file(options.file);
  OutputFiles files;
  std::ostream* const json = files.add(options.json);
  AabbsRun result;
  try {
    aabbs::Reader reader(file.stream());
    StatusLine status;
    result = Run(options, reader).go(status);
  } catch (const aabbs::AabbsError& error) {
    throw BadInput(fmt::format("{}: {}", from_stdin ? "standard input" : options.file, error.what()));
  }
  if (json != nullptr) *json << aabbs_json(result);
  files.commit();
  if (options.json != "-") print(aabbs_text(result));
  if (!result.first_difference.empty()) throw std::runtime_error("pairs differ: " + result.first_difference);
  return 0;
}

Action set_up_aabbs(CommandLine& command) {
  const auto options = std::make_shared<AabbsOptions>();
  add_input(command, "FILE", options->file, "Frames (simulate --record, or Broadmark); - is standard input")
      ->required();
  take_broadphase(command, add_name(command, "--broadphase", options->broadphase, "{}; default: world"), {"world"});
  take_broadphase(command, add_name(command, "--compare", options->compare, "Run this one too, and compare pairs"),
                  {"world"});
  CLI::Option* const max_pairs = add_max_pairs(command, options->max_pairs);
  CLI::Option* const memory = command.add_option(
      "--memory", options->memory,
      "For frames of any size: search with about this much memory (64K or more; 1G), and a temporary file");
  take_size(memory->type_name("BYTES"), std::uint64_t{64} << 10, std::uint64_t{1} << 50)
      ->excludes(command.get_option("--broadphase"))
      ->excludes(command.get_option("--compare"))
      ->excludes(max_pairs);
  add_file(command, "--temporary", options->directory, "Folder of the temporary file; default: the system's")
      ->type_name("DIR")
      ->needs(memory);
  add_file(command, "--pairs", options->pairs, "Write each pair, a line each: frame, a, b; - is standard output")
      ->needs(memory);
  add_json(command, options->json);
  command.last_counts({"--broadphase", "--compare", "--max-pairs", "--memory", "--temporary", "--pairs", "--json"});
  return [options] { return run_aabbs(*options); };
}

}  // namespace

extern const Command aabbs_command{"aabbs", "Find the pairs in each frame of a file of boxes",
                                   R"(Examples:
  boxstream simulate pile --record pile.aabbs
  boxstream aabbs pile.aabbs --compare dbvt
  boxstream aabbs Brownian.aabbs --broadphase dbvt --json - | jq .broadphases

Files of Broadmark: the boxes of the same objects, frame after frame. Each frame gives all boxes to the broad-phase and
asks for the pairs. Broad-phases: world, which is boxstream's own and the default, and those of simulate, as Bullet calls
them. No pair is filtered out, not even of two boxes that never move.

--compare runs two of them. "pairs equal: yes" means: in every frame the pairs whose boxes overlap are the same sets, and
those of an independent search. It stops at the first frame where they are not.

Times are from the first box of a frame to its last pair; the first frame makes the objects.

--memory finds the pairs of frames that are larger than memory: space is divided into regions, and the boxes of each are
written to a temporary file, read and searched. The file has no name, so that nothing is left of it however the run ends.
  boxstream aabbs --memory 1G huge.aabbs --pairs pairs.csv

Exit code: 0; 1 if pairs differ; 2 for bad input: a file of another kind or size.)",
                                   set_up_aabbs};

}  // namespace boxstream::tool
