// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include <boxstream/detector.hpp>
#include <boxstream/out_of_core.hpp>

#include "commands/commands.hpp"
#include "inputs/batches.hpp"
#include "peers/pair_hash.hpp"
#include "tables/measuring.hpp"

namespace boxstream::bench {

namespace {

/// Boxes in blocks as a file gives them.
class Blocks final : public BoxReader {
 public:
  explicit Blocks(Span<const Aabb> boxes) : boxes_(boxes) {}

  void rewind() override { next_ = 0; }
  Span<const Aabb> read() override {
    constexpr std::size_t most = 32768;
    const std::size_t begin = next_;
    next_ = std::min(boxes_.size(), next_ + most);
    return {boxes_.data() + begin, next_ - begin};
  }

 private:
  Span<const Aabb> boxes_;
  std::size_t next_ = 0;
};

PairSummary hash_in_memory(Span<const Aabb> boxes) {
  PairSummary hash;
  Detector().stream_pairs(boxes, [&](Span<const Pair> pairs) {
    for (const Pair pair : pairs) hash.add(pair.a, pair.b);
    return true;
  });
  return hash;
}

PairSummary hash_out_of_core(Span<const Aabb> boxes, std::uint64_t memory, OutOfCoreStats& stats) {
  PairSummary hash;
  Blocks blocks(boxes);
  const auto sink = [&](Span<const WidePair> pairs) {
    for (const WidePair pair : pairs) hash.add(static_cast<std::uint32_t>(pair.a), static_cast<std::uint32_t>(pair.b));
    return true;
  };
  stats = stream_pairs(blocks, sink, {memory});
  return hash;
}

std::string row(const std::string& batch, std::size_t n, std::uint64_t mebibytes, int repeats, std::uint64_t seed) {
  const std::vector<Aabb> boxes = batches::make(batch, n, seed);
  std::vector<double> in_memory, out_of_core;
  OutOfCoreStats stats;
  PairSummary expected, found;
  for (int i = 0; i < repeats; ++i) {
    in_memory.push_back(time_once([&] { expected = hash_in_memory(boxes); }));
    out_of_core.push_back(time_once([&] { found = hash_out_of_core(boxes, mebibytes << 20, stats); }));
    if (!(found == expected)) throw std::runtime_error(batch + ": pairs differ");
  }
  const auto of_input = [&](std::uint64_t bytes) {
    return static_cast<double>(bytes) / static_cast<double>(n * sizeof(Aabb));
  };
  return fmt::format("| {} | {} | {} | {} | {} | {:.2f} | {:.1f} | {:.1f} | {:.1f} | {:.2f} |\n", batch, n, mebibytes,
                     stats.pairs, stats.searches, static_cast<double>(stats.copies) / static_cast<double>(n),
                     of_input(stats.boxes_read * sizeof(Aabb)), of_input(stats.bytes_written),
                     of_input(stats.bytes_read), summarize(out_of_core).median / summarize(in_memory).median);
}

}  // namespace

int run_large(int argc, char** argv) {
  CLI::App app(
      "Times searches out of core, with less memory than the boxes take, beside searches in memory, interleaved, "
      "checks that the pairs are equal, and prints a table in Markdown. Volumes are multiples of the boxes' own.");
  std::vector<std::string> batches{"U", "S", "lattice", "heap", "rods"};
  std::vector<double> sizes{1e6};
  std::vector<std::uint64_t> memory{16};
  int repeats = 3;
  std::uint64_t seed = 1;
  app.add_option("--case", batches, "batches")->delimiter(',');
  app.add_option("--n", sizes, "numbers of boxes")->delimiter(',')->check(CLI::Range(1.0, 4e9));
  app.add_option("--memory", memory, "MiB to work in")->delimiter(',')->check(CLI::Range(1, 1 << 20));
  app.add_option("--repeats", repeats, "rounds; medians are shown")->check(CLI::Range(1, 1000));
  app.add_option("--seed", seed, "of the boxes");
  if (const auto exit_code = parse(app, argc, argv)) return *exit_code;
  fmt::print(
      "| batch | boxes | MiB | pairs | searches | copies a box | input read | file written | file read | time / in "
      "memory |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const std::string& batch : batches)
    for (const double n : sizes)
      for (const std::uint64_t mebibytes : memory) {
        fmt::print("{}", row(batch, static_cast<std::size_t>(n), mebibytes, repeats, seed));
        std::fflush(stdout);
      }
  return 0;
}

}  // namespace boxstream::bench
