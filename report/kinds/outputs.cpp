// SPDX-License-Identifier: MIT
// One batch, more and more of its pairs touching, and what each form of the answer costs: counted, streamed, listed,
// sorted, as changes since the frame before.
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "accuracy/stopwatch.hpp"
#include "accuracy/turns.hpp"
#include "all.hpp"
#include "batches/random.hpp"
#include "boxes/output_forms.hpp"
#include "boxes/pair_difference.hpp"
#include "motion.hpp"
#include "understood.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;
using Pairs = std::vector<Pair>;

/// Cubes scattered over the unit cube, of which a share `wanted` of all pairs touches.
TwoFrames make_input(std::size_t n, double wanted) {
  // Two intervals of length s with starts uniform on [0, 1] meet with probability 2 s - s^2.
  const auto side = static_cast<float>(1 - std::sqrt(std::max(0.0, 1 - std::cbrt(wanted))));
  batches::Random random(1);
  TwoFrames input{};
  for (std::size_t i = 0; i < n; ++i) {
    Aabb box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = static_cast<float>(random.unit());
      box.max[d] = box.min[d] + side;
    }
    input.before.push_back(box);
  }
  bench::MovingBoxes moving(input.before, bench::Brownian{1, 0.1}, 1);
  moving.next_frame();
  input.now.assign(moving.boxes().begin(), moving.boxes().end());
  const Pairs old = reference_pairs(input.before), pairs = reference_pairs(input.now);
  Pairs begun, ended;
  std::set_difference(pairs.begin(), pairs.end(), old.begin(), old.end(), std::back_inserter(begun));
  std::set_difference(old.begin(), old.end(), pairs.begin(), pairs.end(), std::back_inserter(ended));
  const auto all = static_cast<double>(n) * static_cast<double>(n - 1) / 2;
  input.share = static_cast<double>(pairs.size()) / all;
  input.count = pairs.size();
  input.pairs = bench::summarize(pairs);
  for (const Pair& pair : pairs) input.sum += key_of(pair);
  input.changes = changes_of(begun, ended);
  input.begun = begun.size();
  input.ended = ended.size();
  return input;
}

std::size_t bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

struct Candidate {
  const TwoFrames* input;
  std::string name;
  double bytes = 0;
  std::string failure;
};

/// Milliseconds; notes the memory that is held afterwards.
double timed(Candidate& candidate) {
  const std::size_t before = bytes_in_use();
  const std::unique_ptr<OutputForm> output = make_output_form(candidate.name);
  output->first(candidate.input->before);
  const double ms = accuracy::stopwatch([&] { output->run(candidate.input->now); });
  candidate.bytes = static_cast<double>(bytes_in_use() - before);
  if (!output->agrees(*candidate.input)) candidate.failure = "not the pairs, or the changes, that there are";
  return ms;
}

}  // namespace

Results outputs_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress) {
  return with_settings_of(experiment, [&](const json& settings) {
    Results results;
    results.cost_unit = "ms per batch";
    results.metrics = {"ns_per_pair", "bytes_per_pair", "pairs", "changes", "wrong"};
    const auto n = settings.at("boxes").get<std::size_t>();
    const std::string panel = fmt::format("{} boxes", n);
    std::vector<std::unique_ptr<TwoFrames>> inputs;
    std::vector<Candidate> candidates;
    for (const auto share : settings.at("shares").get<std::vector<double>>()) {
      progress(fmt::format("{:g} of all pairs", share));
      inputs.push_back(std::make_unique<TwoFrames>(make_input(n, share)));
      for (const json& name : settings.at("outputs")) {
        (void)make_output_form(name);
        candidates.push_back({inputs.back().get(), name, 0, {}});
      }
    }
    const accuracy::Turns turns = accuracy::take_turns(candidates.size(), options.repeats, [&](std::size_t i) {
      progress(fmt::format("{:.2g} of all pairs: {}", candidates[i].input->share, candidates[i].name));
      return timed(candidates[i]);
    });
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const Candidate& candidate = candidates[i];
      const TwoFrames& input = *candidate.input;
      const auto pairs = static_cast<double>(input.count);
      results.points.push_back(
          {.panel = panel,
           .series = candidate.name,
           .setting = fmt::format("{:.2g}", input.share),
           .x = input.share,
           .cost = turns.costs[i],
           .values = {1e6 * turns.costs[i].median / pairs, candidate.bytes / pairs, pairs,
                      static_cast<double>(input.begun + input.ended), candidate.failure.empty() ? 0.0 : 1.0},
           .failure = candidate.failure});
    }
    results.twins.push_back({panel, turns.twin_spread});
    return results;
  });
}

}  // namespace boxstream::report
