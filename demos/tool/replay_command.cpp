// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "bad_input.hpp"
#include "broadphase_name.hpp"
#include "commands.hpp"
#include "engine/broadphases.hpp"
#include "files/output_file.hpp"
#include "files/read_file.hpp"
#include "print.hpp"
#include "record/recorder.hpp"
#include "record/replay.hpp"
#include "record/text.hpp"
#include "replay_report.hpp"
#include "scene/scene.hpp"
#include "status_line.hpp"

namespace boxstream::tool {
namespace {

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
        name, scenes::make_broadphase(name, bounds_of(run.header), std::max<std::uint64_t>(1, run.census.most_alive))));
  run.result = record::replay(bytes, players, cut_off, [&](std::uint64_t batches, std::uint64_t pairs) {
    status.step(batches, run.census.batches, run.census.most_alive, pairs);
  });
  return run;
}

}  // namespace

int replay_command(const ReplayOptions& options) {
  check_broadphase(options.broadphase);
  if (options.compare) check_broadphase(*options.compare);
  if (options.dump && (options.compare || !options.json.empty()))
    throw BadInput("--dump replays nothing, so it goes with neither --compare nor --json");
  const auto cut_off = options.partial ? record::CutOff::is_end : record::CutOff::is_error;
  const std::string file = load(options.file);
  const Span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(file.data()), file.size());
  std::optional<files::OutputFile> json_file;
  if (!options.json.empty()) json_file.emplace(options.json);
  try {
    if (options.dump) {
      dump(bytes, cut_off);
      return 0;
    }
    const ReplayRun run = replay(options, bytes, cut_off);
    if (json_file) {
      json_file->stream() << replay_json(run);
      json_file->commit();
    }
    if (options.json != "-") print(replay_text(run));
    if (!run.result.difference) return 0;
    throw std::runtime_error("pairs differ: " + record::describe(*run.result.difference, run.header.scalar));
  } catch (const record::RecordError& error) {
    throw BadInput(fmt::format("{}: {}", options.file == "-" ? "standard input" : options.file, error.what()));
  }
}

}  // namespace boxstream::tool
