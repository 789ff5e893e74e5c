// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>

#include <boxstream/detector.hpp>

#include "commands/commands.hpp"
#include "inputs/bad_recipes.hpp"
#include "inputs/recipe.hpp"
#include "peers/pair_hash.hpp"
#include "suites/batch_contest.hpp"
#include "tables/measuring.hpp"

namespace boxstream::bench {

namespace {

/// More pairs a box than this say more about writing pairs than about finding them.
constexpr std::uint64_t most_pairs_a_box = 40;

struct Outcome {
  std::uint64_t pairs = 0;
  double ours_ms = 0;
  double peer_ms = 0;  // of the best configuration; 0 without a peer
  std::string peer;
  bool pairs_equal = true;
  Stats stats;

  double cost(std::size_t n) const { return 1e6 * ours_ms / static_cast<double>(n + pairs); }
  double ratio() const { return peer_ms / ours_ms; }
  /// Comparisons and boxes taken into leaves, by the order that the method is proved to have.
  double work(std::size_t n) const {
    const double count = static_cast<double>(n), log = std::log2(count);
    return static_cast<double>(stats.tests + stats.records) / (count * log * log * log + static_cast<double>(pairs));
  }
};

/// Times recipes: ours, and the configurations of one peer.
class Judge {
 public:
  explicit Judge(std::vector<PeerConfig> peers, bool by_work = false) : peers_(std::move(peers)), by_work_(by_work) {}

  bool has_peers() const { return !peers_.empty(); }

  /// Nothing if there are too many pairs. The best of `repeats` runs of each.
  std::optional<Outcome> judge(const Recipe& recipe, int repeats) {
    const std::vector<Aabb> boxes = make_boxes(recipe);
    if (has_too_many_pairs(boxes)) return {};
    Outcome outcome;
    outcome.ours_ms = best_of(by_work_ ? 0 : repeats, [&] { outcome.stats = detector_.find_pairs(boxes, pairs_); });
    outcome.pairs = pairs_.size();
    const PairSummary expected = summarize(pairs_);
    for (const PeerConfig& config : peers_) {
      config.peer->prepare(boxes);
      const double ms = best_of(repeats, [&] { config.peer->find_pairs(boxes, pairs_); });
      config.peer->release();
      if (outcome.peer_ms == 0 || ms < outcome.peer_ms) {
        outcome.peer_ms = ms;
        outcome.peer = config.name;
      }
      outcome.pairs_equal = outcome.pairs_equal && summarize(pairs_) == expected;
    }
    return outcome;
  }

  /// The larger, the worse for us.
  double badness(const Outcome& outcome, const Recipe& recipe) const {
    if (by_work_) return outcome.work(recipe.n);
    return has_peers() ? 1 / outcome.ratio() : outcome.cost(recipe.n);
  }

 private:
  /// Of one call; quick calls are made several times a sample, because the clock is coarse.
  static double best_of(int repeats, const std::function<void()>& run) {
    constexpr double sample_ms = 0.3;
    double best = time_once(run);
    const int calls = static_cast<int>(sample_ms / (best + 1e-6)) + 1;
    for (int i = 0; i < repeats; ++i)
      best = std::min(best, time_once([&] {
                              for (int call = 0; call < calls; ++call) run();
                            }) / calls);
    return best;
  }

  bool has_too_many_pairs(const std::vector<Aabb>& boxes) {
    const std::uint64_t limit = most_pairs_a_box * boxes.size();
    std::uint64_t seen = 0;
    detector_.stream_pairs(boxes, [&](Span<const Pair> pairs) { return (seen += pairs.size()) <= limit; });
    return seen > limit;
  }

  std::vector<PeerConfig> peers_;
  bool by_work_;
  Detector detector_;
  std::vector<Pair> pairs_;
};

void shrink(Recipe& recipe) {
  for (Part& part : recipe.parts)
    for (double& size : part.size) size -= 0.5;
}

void print(const Recipe& recipe, const Outcome& outcome, const std::string& against) {
  fmt::print("ours {:.4g} ms, {} pairs, {:.1f} ns per box and pair", outcome.ours_ms, outcome.pairs,
             outcome.cost(recipe.n));
  if (!outcome.peer.empty())
    fmt::print("; {} {:.4g} ms, ratio {:.3f}{}", outcome.peer, outcome.peer_ms, outcome.ratio(),
               outcome.pairs_equal ? "" : ", FAIL: pairs differ");
  const double n = static_cast<double>(recipe.n);
  fmt::print("\n  per box: {:.2f} records, {:.1f} tests, {:.4f} (n log^3 n + k) in all; {} nodes, {} cells\n",
             static_cast<double>(outcome.stats.records) / n, static_cast<double>(outcome.stats.tests) / n,
             outcome.work(recipe.n), outcome.stats.nodes, outcome.stats.cells);
  fmt::print("  replay: boxstream_bench worst --against {} --recipe '{}'\n", against, to_text(recipe));
  std::fflush(stdout);
}

/// Random recipes for a third of the time, then mutations of the worst few: true if all pairs agreed.
bool search(Judge& judge, std::size_t n, std::uint64_t seed, double seconds, const std::string& against) {
  struct Found {
    Recipe recipe;
    double badness;
  };
  constexpr std::size_t kept = 4;
  std::vector<Found> worst;  // the worst first
  batches::Random random(seed);
  Progress progress;
  const Elapsed elapsed;
  int tried = 0;
  bool all_equal = true;
  while (elapsed.seconds() < seconds) {
    const bool explore = worst.size() < kept || elapsed.seconds() < seconds / 3 || random.unit() < 0.1;
    Recipe recipe =
        explore
            ? random_recipe(n, random)
            : mutated(worst[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(kept) - 1))].recipe,
                      random);
    std::optional<Outcome> outcome;
    for (int attempt = 0; attempt < 10 && !(outcome = judge.judge(recipe, 2)); ++attempt) shrink(recipe);
    if (!outcome) continue;
    ++tried;
    if (!outcome->pairs_equal) {
      progress.clear();
      print(recipe, *outcome, against);
      all_equal = false;
    }
    double badness = judge.badness(*outcome, recipe);
    if (worst.size() == kept && badness <= worst.back().badness) continue;
    // A disturbed measurement must not lead the search astray.
    outcome = judge.judge(recipe, 5);
    badness = judge.badness(*outcome, recipe);
    worst.push_back({recipe, badness});
    std::sort(worst.begin(), worst.end(), [](const Found& a, const Found& b) { return a.badness > b.badness; });
    if (worst.size() > kept) worst.pop_back();
    progress.show(fmt::format("worst: {} tried, {:.0f} of {:.0f} s, badness {:.4g}", tried, elapsed.seconds(), seconds,
                              worst.front().badness));
  }
  progress.clear();
  fmt::print("{} batches of {} boxes tried, seed {}; the worst:\n", tried, n, seed);
  for (const Found& found : worst) print(found.recipe, *judge.judge(found.recipe, 7), against);
  return all_equal;
}

/// The batches of earlier searches, beside the peers that need no structure: true if all pairs agreed.
bool measure_known() {
  std::vector<PeerConfig> peers = make_peers(1);
  std::erase_if(peers,
                [](const PeerConfig& p) { return p.family != "cgal" && p.family != "sweep" && p.family != "brute"; });
  Judge judge(std::move(peers));
  bool all_equal = true;
  for (const char* text : bad_recipes) {
    const Recipe recipe = parse_recipe(text);
    const std::optional<Outcome> outcome = judge.judge(recipe, 5);
    print(recipe, outcome.value(), "sweep");
    all_equal = all_equal && outcome->pairs_equal;
  }
  return all_equal;
}

}  // namespace

int run_worst(int argc, char** argv) {
  CLI::App app(
      "Searches mixtures of clusters, shells, lattices, bars, nested heaps, plates, sizes and orders for the batch on "
      "which "
      "boxstream takes longest per box and pair, or does worst beside a peer. Prints recipes that can be replayed.");
  std::size_t n = 20000;
  std::uint64_t seed = 1;
  double seconds = 20;
  std::string against = "nobody", recipe;
  app.add_option("--n", n, "boxes")->check(CLI::Range(2, 10000000))->capture_default_str();
  app.add_option("--seed", seed, "of the search")->capture_default_str();
  app.add_option("--seconds", seconds, "to search")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--against", against,
                 "nobody: nanoseconds per box and pair; bound: comparisons and copies by n log^3 n + k; or a peer, as "
                 "sweep, cgal, brute: the ratio")
      ->capture_default_str();
  app.add_option("--recipe", recipe, "measure this one instead of searching");
  bool known = false;
  app.add_flag("--known", known, "measure those found before, beside cgal, sweep and brute");
  if (const auto exit_code = parse(app, argc, argv)) return *exit_code;

  if (known) return measure_known() ? 0 : 1;
  const bool by_work = against == "bound";
  Judge judge(by_work || against == "nobody" ? std::vector<PeerConfig>() : choose_peers(make_peers(1), {against}),
              by_work);
  if (recipe.empty()) return search(judge, n, seed, seconds, against) ? 0 : 1;
  const Recipe wanted = parse_recipe(recipe);
  const std::optional<Outcome> outcome = judge.judge(wanted, 7);
  if (!outcome) throw std::invalid_argument(fmt::format("the recipe makes more than {} pairs a box", most_pairs_a_box));
  print(wanted, *outcome, against);
  return outcome->pairs_equal ? 0 : 1;
}

}  // namespace boxstream::bench
