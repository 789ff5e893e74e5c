// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "base/read_file.hpp"
#include "boxstream/replay/reports.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/output_files.hpp"
#include "boxstream/shared/print.hpp"
#include "formats/record/op.hpp"
#include "formats/record/recorder.hpp"
#include "formats/record/replay.hpp"
#include "formats/scene_model/scene.hpp"
#include "simulation/engine/broadphases.hpp"

namespace boxstream::tool {
namespace {

struct ReplayOptions {
  std::string file;  // "-": standard input
  std::string broadphase = "boxstream";
  std::optional<std::string> compare;
  std::string json;                                    // empty: none; "-": standard output, in place of the text
  std::uint64_t max_pairs = record::usual_most_pairs;  // at once
  bool partial = false;                                // a file that is cut off is taken for what is there
  bool dump = false;                                   // print the calls, and replay nothing
};

std::string load(const std::string& path) {
  std::string bytes = files::read_file(path, files::most_of_recording);
  if (bytes.empty() && path != "-") throw BadInput(fmt::format("{}: is empty", path));
  return bytes;
}

/// The calls up to the end, or to the place where the file is broken.
void dump(Span<const std::uint8_t> bytes, record::CutOff cut_off) {
  record::Reader reader(bytes, cut_off);
  const record::Scalar scalar = reader.header().scalar;
  print(record::text_of(reader.header()) + "\n");
  std::string lines;
  const auto flush = [&] {
    print(lines);
    lines.clear();
  };
  try {
    std::uint64_t batches = 0;
    while (const auto op = reader.next()) {
      lines += record::text_of(*op, scalar);
      if (std::holds_alternative<record::Batch>(*op)) lines += fmt::format(" (batch {})", ++batches);
      lines += '\n';
      if (lines.size() > 65536) flush();
    }
  } catch (const record::RecordError&) {
    flush();
    throw;
  }
  flush();
}

scenes::Bounds bounds_of(const record::Header& header) {
  scenes::Bounds bounds;
  std::copy(std::begin(header.bounds.min), std::end(header.bounds.min), bounds.min.begin());
  std::copy(std::begin(header.bounds.max), std::end(header.bounds.max), bounds.max.begin());
  return bounds;
}

/// bt32BitAxisSweep3 sorts by sides and trusts that min comes before max: other boxes make it write where it should
/// not.
void check_boxes(const std::string& broadphase, const record::Census& census) {
  if (broadphase == "sap" && census.invalid_boxes > 0)
    throw record::RecordError(
        fmt::format("sap takes no boxes with a NaN or min > max, of which there are {} here", census.invalid_boxes));
}

ReplayRun replay(const ReplayOptions& options, Span<const std::uint8_t> bytes, record::CutOff cut_off) {
  StatusLine status;
  ReplayRun run{options.file, record::Reader(bytes).header(), {}, {options.broadphase}, {}};
  if (options.compare) run.broadphases.push_back(*options.compare);
  if (run.header.scalar != record::bullet_scalar)
    throw record::RecordError("recorded in double precision; Bullet here is in float (--dump reads both)");
  status.say("reading");
  run.census = record::census_of(bytes, cut_off);
  for (const std::string& name : run.broadphases) check_boxes(name, run.census);
  std::vector<std::unique_ptr<record::Player>> players;
  for (const std::string& name : run.broadphases)
    players.push_back(std::make_unique<record::Player>(
        name, scenes::make_broadphase(name, bounds_of(run.header), std::max<std::uint64_t>(1, run.census.most_alive)),
        options.max_pairs));
  const auto progress = [&](std::uint64_t batches, std::uint64_t pairs) {
    status.step(batches, run.census.batches, run.census.most_alive, pairs);
  };
  run.result = record::replay(bytes, players, cut_off, progress, options.max_pairs);
  return run;
}

int run_replay(const ReplayOptions& options) {
  if (options.dump && (options.compare || !options.json.empty()))
    throw BadInput("--dump replays nothing, so it goes with neither --compare nor --json");
  const auto cut_off = options.partial ? record::CutOff::is_end : record::CutOff::is_error;
  const std::string file = load(options.file);
  const Span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(file.data()), file.size());
  OutputFiles files;
  std::ostream* const json = files.add(options.json);
  try {
    if (options.dump) {
      dump(bytes, cut_off);
      return 0;
    }
    const ReplayRun run = replay(options, bytes, cut_off);
    if (json != nullptr) *json << replay_json(run);
    files.commit();
    if (options.json != "-") print(replay_text(run));
    if (!run.result.difference) return 0;
    throw std::runtime_error("pairs differ: " + record::describe(*run.result.difference, run.header.scalar));
  } catch (const record::RecordError& error) {
    throw BadInput(fmt::format("{}: {}", options.file == "-" ? "standard input" : options.file, error.what()));
  }
}

Action set_up_replay(CommandLine& command) {
  const auto options = std::make_shared<ReplayOptions>();
  add_input(command, "FILE", options->file, "Recording (simulate --log); - is standard input")->required();
  take_broadphase(command, add_name(command, "--broadphase", options->broadphase, "{}; default: boxstream"));
  take_broadphase(command, add_name(command, "--compare", options->compare, "Replay on this one too"));
  add_json(command, options->json, "Write the result");
  add_max_pairs(command, options->max_pairs);
  command.add_flag("--partial", options->partial, "A file that is cut off: replay what is there");
  command.add_flag("--dump", options->dump, "Print the calls, one a line, and replay nothing");
  command.last_counts({"--broadphase", "--compare", "--max-pairs", "--json"});
  return [options] { return run_replay(*options); };
}

}  // namespace

extern const Command replay_command{"replay", "Make recorded calls to a broad-phase, and find the first wrong pair",
                                    R"(Examples:
  boxstream simulate pile --log pile.bsrec
  boxstream replay pile.bsrec --broadphase dbvt --compare sap
  boxstream replay pile.bsrec --dump | less

Makes the calls that a world made to its broad-phase, without the world. After each batch (calculateOverlappingPairs)
these must be the same sets: the pairs of each broad-phase whose boxes overlap (some hold near misses beside them), those
of an independent search, and those that the recording has a hash of. Hits of box queries likewise, but for the
recording. The first batch where they differ is printed, and the first pair with its boxes.

A program that crashes while it records leaves a file that is cut off (of simulate: FILE.NUMBER.part), with all batches
up to then: replay it with --partial.

Times are those of all calls of a broad-phase: boxes, queries and batches.

Memory is in proportion to the file and to the pairs that there are at once, some 170 bytes each and broad-phase. A few
kilobytes can ask for millions; more than --max-pairs are refused.

Exit code: 0; 1 if something differs; 2 for bad input: a file that is no recording, or broken.)",
                                    set_up_replay};

}  // namespace boxstream::tool
