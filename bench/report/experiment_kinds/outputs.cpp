// SPDX-License-Identifier: MIT
// One batch, with growing shares of its pairs touching, and the cost of each form of output: counted, streamed, listed,
// sorted, as changes since the frame before.
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "boxes/output_forms.hpp"
#include "boxes/pair_difference.hpp"
#include "experiment_kinds/kinds.hpp"
#include "inputs/motion.hpp"
#include "inputs/random.hpp"

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
  const OutputForm output = make_output_form(candidate.name);
  output.run(candidate.input->before);
  const double ms = measure::time_once([&] { output.run(candidate.input->now); });
  candidate.bytes = static_cast<double>(bytes_in_use() - before);
  if (!output.agrees(*candidate.input)) candidate.failure = "wrong pairs or changes";
  return ms;
}

}  // namespace

void measure_outputs(Measurement& measurement) {
  const json& settings = measurement.settings();
  const auto n = settings.at("boxes").get<std::size_t>();
  std::vector<std::unique_ptr<TwoFrames>> inputs;
  std::vector<Candidate> candidates;
  for (const auto share : settings.at("shares").get<std::vector<double>>()) {
    measurement.progress(fmt::format("{:g} of all pairs", share));
    inputs.push_back(std::make_unique<TwoFrames>(make_input(n, share)));
    for (const json& name : settings.at("outputs")) {
      (void)make_output_form(name);
      candidates.push_back({inputs.back().get(), name, 0, {}});
    }
  }
  const auto timed_one = [&](Candidate& candidate) {
    measurement.progress(fmt::format("{:.2g} of all pairs: {}", candidate.input->share, candidate.name));
    return timed(candidate);
  };
  const auto point_of = [](const Candidate& candidate, const measure::Estimate& cost) {
    const TwoFrames& input = *candidate.input;
    const auto pairs = static_cast<double>(input.count);
    return Point{.series = candidate.name,
                 .setting = fmt::format("{:.2g}", input.share),
                 .x = input.share,
                 .values = {1e6 * cost.median / pairs, candidate.bytes / pairs, pairs,
                            static_cast<double>(input.begun + input.ended), candidate.failure.empty() ? 0.0 : 1.0},
                 .failure = candidate.failure};
  };
  measurement.add_points(fmt::format("{} boxes", n), candidates, timed_one, point_of);
}

}  // namespace boxstream::report
