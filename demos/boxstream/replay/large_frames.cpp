// SPDX-License-Identifier: MIT
#include "boxstream/replay/large_frames.hpp"

#include <fmt/format.h>

#include <chrono>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/words.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/report.hpp"
#include "formats/aabbs/frame_boxes.hpp"
#include "formats/aabbs/reader.hpp"

namespace boxstream::tool {
namespace {

using Json = nlohmann::ordered_json;

/// Says how far a frame has been read.
class ToldBoxes final : public BoxReader {
 public:
  ToldBoxes(aabbs::FrameBoxes& boxes, std::string name, std::uint64_t objects, StatusLine& status)
      : boxes_(boxes), name_(std::move(name)), objects_(objects), status_(status) {}

  void rewind() override { boxes_.rewind(); }
  Span<const Aabb> read() override {
    const auto block = boxes_.read();
    if (++reads_ % 64 == 0)
      status_.say(fmt::format("{}   pass {}: {} % read", name_, boxes_.passes(), 100 * boxes_.position() / objects_));
    return block;
  }

 private:
  aabbs::FrameBoxes& boxes_;
  std::string name_;
  std::uint64_t objects_, reads_ = 0;
  StatusLine& status_;
};

}  // namespace

LargeFrames find_in_large_frames(std::istream& in, const std::string& file, const OutOfCoreOptions& options,
                                 std::ostream* pairs, StatusLine& status) {
  LargeFrames run{file, aabbs::Reader(in).header(), options.memory, {}};
  const std::uint64_t frames = aabbs::frames_in(in, run.header);
  if (frames == 0) throw BadInput(file + ": --memory reads frames more than once, which takes a file");
  if (pairs != nullptr) *pairs << "frame,a,b\n";
  for (std::uint64_t frame = 0; frame < frames; ++frame) {
    const std::string name = fmt::format("frame {} of {}", frame + 1, frames);
    aabbs::FrameBoxes boxes(in, run.header, frame);
    ToldBoxes told(boxes, name, run.header.objects, status);
    std::uint64_t found = 0;
    std::string lines;
    const auto sink = [&](Span<const WidePair> batch) {
      if ((found + batch.size()) >> 22 != found >> 22) status.say(fmt::format("{}   {} pairs", name, found));
      found += batch.size();
      if (pairs == nullptr) return true;
      lines.clear();
      for (const WidePair pair : batch) fmt::format_to(std::back_inserter(lines), "{},{},{}\n", frame, pair.a, pair.b);
      return bool(*pairs << lines);  // if not, the search ends, and whose stream it is knows the reason
    };
    const auto begin = std::chrono::steady_clock::now();
    const OutOfCoreStats stats = stream_pairs(told, sink, options);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    run.frames.push_back({stats, spent.count()});
    if (pairs != nullptr && !*pairs) break;
  }
  return run;
}

std::string large_frames_text(const LargeFrames& run) {
  std::string text =
      fmt::format("scene          {} ({})\n", files::printable(run.header.scene), files::printable(run.header.type));
  text += fmt::format("boxes          {} in {} frames\n", grouped(run.header.objects), grouped(run.frames.size()));
  text += fmt::format("{:<8}{:>16}{:>12}{:>16}{:>16}{:>10}{:>10}\n", "frame", "pairs", "invalid", "boxes read",
                      "boxes written", "searches", "s");
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const OutOfCoreStats& s = run.frames[i].stats;
    text += fmt::format("{:<8}{:>16}{:>12}{:>16}{:>16}{:>10}{:>10.2f}\n", i, grouped(s.pairs), grouped(s.invalid),
                        grouped(s.boxes_read), grouped(s.copies), grouped(s.searches), run.frames[i].seconds);
  }
  return text;
}

std::string large_frames_json(const LargeFrames& run) {
  Json document = report_about({{"file", run.file},
                                {"scene", run.header.scene},
                                {"type", run.header.type},
                                {"objects", run.header.objects},
                                {"steps", run.header.steps},
                                {"memory", run.memory}});
  document["frames"] = Json::array();
  for (const auto& [stats, seconds] : run.frames)
    document["frames"].push_back({{"pairs", stats.pairs},
                                  {"invalid", stats.invalid},
                                  {"boxes_read", stats.boxes_read},
                                  {"searches", stats.searches},
                                  {"copies", stats.copies},
                                  {"bytes_written", stats.bytes_written},
                                  {"bytes_read", stats.bytes_read},
                                  {"file_bytes", stats.file_bytes},
                                  {"seconds", seconds}});
  return json_dump(document, 1) + "\n";
}

}  // namespace boxstream::tool
