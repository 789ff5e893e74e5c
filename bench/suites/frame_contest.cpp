// SPDX-License-Identifier: MIT
#include "suites/frame_contest.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "inputs/batches.hpp"
#include "measure/interleave.hpp"
#include "peers/pair_hash.hpp"
#include "suites/batch_contest.hpp"

namespace boxstream::bench {

namespace {

constexpr std::size_t frames_in_block = 5;
/// A peer that is too slow for all frames runs these at least, and then until this part of the limit is used up.
constexpr std::size_t fewest_frames = 3;
constexpr double part_of_limit = 1.0 / 3;

const MotionName* find_motion(const std::string& case_name) {
  const std::size_t colon = case_name.find(':');
  if (colon == std::string::npos) return nullptr;
  for (const MotionName& m : motions())
    if (m.name == std::string_view(case_name).substr(colon + 1)) return &m;
  return nullptr;
}

/// Of the first `count` frames. A sample is the mean of a block: some methods do much in one frame and little in the
/// next.
Series summarize_first(const std::vector<double>& ms, std::size_t count) {
  std::vector<double> means;
  for (std::size_t first = 0; first < std::min(count, ms.size()); first += frames_in_block) {
    const std::size_t last = std::min({count, ms.size(), first + frames_in_block});
    double sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += ms[i];
    means.push_back(sum / static_cast<double>(last - first));
  }
  return summarize(means);
}

FrameTimes frames_of(const std::vector<double>& ms, std::size_t count) {
  const std::vector<double> first(ms.begin(), ms.begin() + static_cast<std::ptrdiff_t>(count));
  return {measure::median(first), measure::quantile(first, 0.99), measure::quantile(first, 1)};
}

}  // namespace

bool is_motion_case(const std::string& case_name) {
  return find_motion(case_name) && is_batch(case_name.substr(0, case_name.find(':')));
}

void FrameContest::Runner::see_pairs() {
  const PairSummary summary = summarize(pairs);
  const std::uint64_t before = chain.empty() ? 0 : chain.back();
  chain.push_back((before + summary.hash) * 0x9e3779b97f4a7c15u + summary.count);
}

void FrameContest::show(const std::string& what) {
  contest_.progress.show(fmt::format("{} {} n={}: {}", contest_.suite, case_name_, n_, what));
}

/// Filling and as few frames as a row needs.
double FrameContest::cheapest_run_ms(Peer& peer, std::size_t n) {
  MovingBoxes moving(scaled_to_unit_sides(batches::make(batch_, n, contest_.options.seed)), motion_,
                     contest_.options.seed);
  std::vector<Pair> pairs;
  peer.prepare(moving.boxes());
  double ms = time_once([&] { peer.find_pairs(moving.boxes(), pairs); });
  moving.next_frame();
  ms += fewest_frames * time_once([&] { peer.next_frame(moving.boxes(), moving.moved(), pairs); });
  peer.release();
  return ms;
}

void FrameContest::choose_runners() {
  runners_.clear();
  skipped_.clear();
  runners_.push_back({"ours", "", "", &contest_.ours.on(1), {}, {}, {}});
  const std::vector<Aabb> boxes = scaled_to_unit_sides(batches::make(batch_, n_, contest_.options.seed));
  const double limit_ms = contest_.limit_ms();
  for (const Span<PeerConfig> family : contest_.families()) {
    if (!family[0].crashes_at.empty() && find_motion(case_name_)->name == family[0].crashes_at) {
      skipped_.push_back(contest_.row_of(case_name_, n_, family[0].family));
      skipped_.back().skipped = "its update crashes at this motion";
      continue;
    }
    double quickest_prediction = 0, best_ms = 0;
    PeerConfig* best = nullptr;
    for (PeerConfig& config : family) {
      show(config.name + ", trial");
      const double predicted = predictor_.predict(case_name_ + ' ' + config.name, n_, limit_ms,
                                                  [&](std::size_t n) { return cheapest_run_ms(*config.peer, n); });
      if (predicted > limit_ms) {
        if (quickest_prediction == 0 || predicted < quickest_prediction) quickest_prediction = predicted;
        continue;
      }
      const bool alone = config.name == config.family;
      const double ms = alone ? 0 : time_peer(*config.peer, boxes, runners_[0].pairs, Clock::cpu);
      if (!best || ms < best_ms) {
        best = &config;
        best_ms = ms;
      }
    }
    if (best) {
      runners_.push_back({best->name, best->family, best->known_difference, best->peer.get(), {}, {}, {}});
    } else {
      Row row = contest_.row_of(case_name_, n_, family[0].family);
      row.skipped = fmt::format("over limit, {:.2g} s or more predicted for filling and {} frames",
                                quickest_prediction / 1000, fewest_frames);
      skipped_.push_back(std::move(row));
    }
  }
}

void FrameContest::run_block(Runner& runner, const std::vector<std::vector<Aabb>>& frames) {
  for (std::size_t f = 0; f < frames.size() && !runner.stopped; ++f) {
    const double ms = time_once([&] { runner.peer->next_frame(frames[f], moved_, runner.pairs); });
    runner.frame_ms.push_back(ms);
    runner.total_ms += ms;
    runner.see_pairs();
    runner.stopped = runner.frame_ms.size() >= fewest_frames && runner.total_ms > contest_.limit_ms() * part_of_limit &&
                     &runner != &runners_.front();
  }
}

void FrameContest::run_blocks() {
  MovingBoxes moving(scaled_to_unit_sides(batches::make(batch_, n_, contest_.options.seed)), motion_,
                     contest_.options.seed);
  moved_.assign(moving.moved().begin(), moving.moved().end());
  for (Runner& runner : runners_) {
    show(runner.name + ", filling");
    runner.peer->prepare(moving.boxes());
    runner.filling_ms = time_once([&] { runner.peer->find_pairs(moving.boxes(), runner.pairs); });
    runner.see_pairs();
  }
  std::vector<std::vector<Aabb>> frames;
  for (int done = 0; done < contest_.options.frames; done += static_cast<int>(frames.size())) {
    frames.clear();
    for (int f = done; f < std::min(contest_.options.frames, done + static_cast<int>(frames_in_block)); ++f) {
      moving.next_frame();
      frames.emplace_back(moving.boxes().begin(), moving.boxes().end());
    }
    for (Runner& runner : runners_) {
      show(fmt::format("frame {} of {}, {}", done, contest_.options.frames, runner.name));
      run_block(runner, frames);
    }
  }
  for (Runner& runner : runners_) {
    predictor_.add(case_name_ + ' ' + runner.name, n_,
                   runner.filling_ms + fewest_frames * summarize(runner.frame_ms).median);
    runner.peer->release();
  }
  contest_.progress.clear();
}

Row FrameContest::row_of(const Runner& runner) const {
  const Runner& ours = runners_.front();
  const std::size_t frames = std::min(runner.frame_ms.size(), ours.frame_ms.size());
  const Series our_series = summarize_first(ours.frame_ms, frames);
  const Series series = summarize_first(runner.frame_ms, frames);
  Row row = contest_.row_of(case_name_, n_, runner.name);
  row.k = ours.pairs.size();
  row.yardstick = runner.name == "detector";  // no peer
  row.set_ours(our_series);
  row.set_peer(series);
  row.samples = frames;
  row.ours_frames = frames_of(ours.frame_ms, frames);
  row.peer_frames = frames_of(runner.frame_ms, frames);
  row.pairs_equal = std::equal(ours.chain.begin(), ours.chain.begin() + static_cast<std::ptrdiff_t>(frames + 1),
                               runner.chain.begin());
  row.known_difference = runner.known_difference;
  if (runner.stopped) row.note = fmt::format("the first {} of {} frames", frames, contest_.options.frames);
  return row;
}

void FrameContest::run(const std::string& case_name, std::size_t n) {
  case_name_ = case_name;
  batch_ = case_name.substr(0, case_name.find(':'));
  motion_ = find_motion(case_name)->motion;
  n_ = n;
  choose_runners();
  run_blocks();
  for (std::size_t i = 1; i < runners_.size(); ++i) contest_.report.add(row_of(runners_[i]));
  const Series ours = summarize_first(runners_.front().frame_ms, runners_.front().frame_ms.size());
  for (Row& row : skipped_) {
    row.k = runners_.front().pairs.size();
    row.set_ours(ours);
    contest_.report.add(std::move(row));
  }
}

}  // namespace boxstream::bench
