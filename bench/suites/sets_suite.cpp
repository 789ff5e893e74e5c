// SPDX-License-Identifier: MIT
#include <algorithm>
#include <functional>

#include <boxstream/box_index.hpp>
#include <boxstream/detector.hpp>

#include "inputs/batches.hpp"
#include "inputs/set_cases.hpp"
#include "peers/cross.hpp"
#include "peers/sorted_sweep.hpp"
#include "suites/race.hpp"
#include "suites/suites.hpp"

namespace boxstream::bench {

namespace {

/// Detectors and pairs of one case.
struct Search {
  Detector ours, other;
  std::vector<Pair> pairs{}, theirs{}, expected{};

  static std::vector<Pair> sorted(std::vector<Pair> pairs) {
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }
  std::function<bool()> equal() {
    return [this] { return sorted(theirs) == expected; };
  }
  void run(Race& race, const std::function<void()>& find) {
    find();
    race.row.k = pairs.size();
    expected = sorted(pairs);
    race.run(find);
  }
};

void run_two(Race& race, Search& search, const TwoSets& sets) {
  const std::vector<CrossPeerConfig> peers = make_cross_peers();
  for (const CrossPeerConfig& peer : peers) {
    // All against all cannot compete where both sets are large.
    if (peer.family == "block-loop" && std::min(sets.a.size(), sets.b.size()) > 20000) continue;
    const auto find = [&] { peer.find_pairs(sets.a, sets.b, search.theirs); };
    race.add(peer.name, find, search.equal(), peer.family);
  }
  search.run(race, [&] { search.ours.find_pairs(sets.a, sets.b, search.pairs); });
}

/// One search for each part, over boxes copied together beforehand; the pairs get the places in the batch.
std::function<void()> by_hand(const Filtered& filtered, Search& search) {
  std::vector<TwoSets> boxes;
  for (const Filtered::Part& part : filtered.parts) {
    boxes.emplace_back();
    for (const std::uint32_t i : part.a) boxes.back().a.push_back(filtered.boxes[i]);
    for (const std::uint32_t i : part.b) boxes.back().b.push_back(filtered.boxes[i]);
  }
  return [boxes, &filtered, &search] {
    search.theirs.clear();
    for (std::size_t p = 0; p < boxes.size(); ++p) {
      const Filtered::Part& part = filtered.parts[p];
      const bool one = part.b.empty();
      const std::vector<std::uint32_t>& places_b = one ? part.a : part.b;
      const auto add = [&](Span<const Pair> found) {
        for (const Pair pair : found)
          search.theirs.push_back(
              {std::min(part.a[pair.a], places_b[pair.b]), std::max(part.a[pair.a], places_b[pair.b])});
        return true;
      };
      if (one)
        search.other.stream_pairs(boxes[p].a, add);
      else
        search.other.stream_pairs(boxes[p].a, boxes[p].b, add);
    }
  };
}

void run_filtered(Race& race, Search& search, const Filtered& filtered) {
  race.add("by-hand", by_hand(filtered, search), search.equal());
  race.add_yardstick("unfiltered", [&] { search.other.find_pairs(filtered.boxes, search.theirs); });
  search.run(race, [&] { search.ours.find_pairs(filtered.boxes, search.pairs, filtered.filters); });
}

std::vector<Aabb> rounded(const std::vector<Aabb64>& boxes) {
  std::vector<Aabb> floats(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (int d = 0; d < 3; ++d) {
      floats[i].min[d] = static_cast<float>(boxes[i].min[d]);
      floats[i].max[d] = static_cast<float>(boxes[i].max[d]);
    }
  return floats;
}

/// Of a batch, or of boxes that share ends.
std::vector<Aabb64> doubles_of(const std::string& name, std::size_t n, std::uint64_t seed) {
  return name.size() == 1 ? batches::make64(name, n, seed) : shared_ends(name, n, seed);
}

void run_double(Race& race, Search& search, const std::vector<Aabb64>& boxes) {
  const std::vector<Aabb> floats = rounded(boxes);
  std::vector<std::uint32_t> order;
  const auto sweep = [&] { sorted_sweep<double>(boxes, order, search.theirs); };
  if (race.row.n <= 100000) race.add("sorted-sweep", sweep, search.equal());
  race.add_yardstick("float", [&] { search.other.find_pairs(floats, search.theirs); });
  search.run(race, [&] { search.ours.find_pairs(boxes, search.pairs); });
}

/// One half against the other.
void run_double_halves(Race& race, Search& search, const std::vector<Aabb64>& boxes) {
  const std::vector<Aabb> floats = rounded(boxes);
  const auto half = [](auto all, bool second) {
    return all.subspan(second ? all.size() / 2 : 0, second ? all.size() - all.size() / 2 : all.size() / 2);
  };
  const auto find = [&](Detector& detector, auto all, std::vector<Pair>& pairs) {
    detector.find_pairs(half(all, false), half(all, true), pairs);
  };
  race.add_yardstick("float", [&] { find(search.other, Span<const Aabb>(floats), search.theirs); });
  search.run(race, [&] { find(search.ours, Span<const Aabb64>(boxes), search.pairs); });
}

/// A batch by rules, beside the same without.
void run_by_rules(Race& race, Search& search, const std::string& name, std::uint64_t seed) {
  const std::vector<Aabb> boxes = batches::make("U", race.row.n, seed);
  race.add_yardstick("plain", [&] { search.other.find_pairs(boxes, search.theirs); });
  PairRules rules;
  std::vector<std::uint32_t> ids;
  if (name == "open") rules.touching = false;
  if (name == "tolerance") rules.tolerance = 1e-6;
  if (name == "ids") {
    for (std::size_t i = 0; i < boxes.size(); ++i) ids.push_back(static_cast<std::uint32_t>(i / 20));
    rules.ids = ids;
  }
  search.run(race, [&] { search.ours.find_pairs(boxes, search.pairs, rules); });
}

/// Neighbours of each box, beside pairs alone, and made of these as a user does.
void run_neighbours(Race& race, Search& search, Directions directions, std::uint64_t seed) {
  const std::vector<Aabb> boxes = batches::make("U", race.row.n, seed);
  std::vector<Pair> all;
  Neighbours rows;
  race.add_yardstick("plain", [&] { search.other.find_pairs(boxes, search.theirs); });
  race.add(
      "sort",
      [&] {
        search.other.find_pairs(boxes, search.theirs);
        all = search.theirs;
        if (directions == Directions::both)
          for (const Pair pair : search.theirs) all.push_back({pair.b, pair.a});
        std::sort(all.begin(), all.end());
      },
      [&] {
        return std::equal(all.begin(), all.end(), rows.indices.begin(), rows.indices.end(),
                          [](Pair pair, std::uint32_t index) { return pair.b == index; });
      });
  race.row.k = search.ours.find_neighbours(boxes, rows, {}, directions).pairs;
  race.run([&] { search.ours.find_neighbours(boxes, rows, {}, directions); });
}

void run_integers(Race& race, Search& search, std::uint64_t seed) {
  const std::vector<Aabb> floats = batches::make("U", race.row.n, seed);
  std::vector<IntAabb> boxes(floats.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (int d = 0; d < 3; ++d) {
      boxes[i].min[d] = static_cast<std::int32_t>(double{floats[i].min[d]} * (1 << 20));
      boxes[i].max[d] = static_cast<std::int32_t>(double{floats[i].max[d]} * (1 << 20));
    }
  race.add_yardstick("float", [&] { search.other.find_pairs(floats, search.theirs); });
  search.run(race, [&] { search.ours.find_pairs(boxes, search.pairs); });
}

/// An index that is loaded, beside making it.
void run_load(Race& race, std::uint64_t seed) {
  const std::vector<Aabb> boxes = batches::make("U", race.row.n, seed);
  const std::vector<std::uint8_t> bytes = BoxIndex(boxes).save();
  BoxIndex index = BoxIndex::load(bytes), built;
  race.add(
      "build", [&] { built = BoxIndex(boxes); }, [&] { return built.save() == index.save(); });
  race.add_yardstick("save", [&] { BoxIndex::load(bytes).save(); });
  race.run([&] { index = BoxIndex::load(bytes); });
}

/// A tenth of the boxes asked about together, beside one by one, and beside a search between two sets.
void run_ask(Race& race, Search& search, std::uint64_t seed) {
  const std::vector<Aabb> boxes = batches::make("U", race.row.n, seed);
  const std::vector<Aabb> places = batches::make("U", std::max<std::size_t>(race.row.n / 10, 1), seed + 1);
  const BoxIndex index(boxes);
  race.add(
      "one-by-one",
      [&] {
        search.theirs.clear();
        for (std::uint32_t i = 0; i < places.size(); ++i)
          index.query_box(places[i], [&](std::uint32_t box) {
            search.theirs.push_back({i, box});
            return true;
          });
      },
      search.equal());
  race.add(
      "two-sets", [&] { search.other.find_pairs(places, boxes, search.theirs); }, search.equal());
  search.run(race, [&] { index.query_boxes(places, search.pairs); });
}

void run_case(const std::string& name, std::size_t n, const Options& options, Report& report, Progress& progress) {
  Race race(options, report, progress, {.suite = "sets", .case_name = name, .n = n});
  Search search;
  if (name.rfind("few-many:", 0) == 0)
    run_two(race, search, few_against_many(std::stoul(name.substr(9)), n, options.seed));
  else if (name == "turned")
    run_two(race, search, turned_meshes(n));
  else if (name == "static90")
    run_filtered(race, search, mostly_static(n, options.seed));
  else if (name == "groups")
    run_filtered(race, search, ten_groups(n, options.seed));
  else if (name == "open" || name == "ids" || name == "tolerance")
    run_by_rules(race, search, name, options.seed);
  else if (name == "neighbours")
    run_neighbours(race, search, Directions::both, options.seed);
  else if (name == "neighbours:one")
    run_neighbours(race, search, Directions::one, options.seed);
  else if (name == "index:load")
    run_load(race, options.seed);
  else if (name == "index:ask")
    run_ask(race, search, options.seed);
  else if (name == "integers")
    run_integers(race, search, options.seed);
  else if (const std::string boxes = name.substr(0, name.find("64")); name.back() == '4')
    run_double(race, search, doubles_of(boxes, n, options.seed));
  else
    run_double_halves(race, search, doubles_of(boxes, n, options.seed));
}

constexpr struct {
  const char *name, *description;
} cases[] = {
    {"few-many:1", "one box against n"},
    {"few-many:10", "ten"},
    {"few-many:100", "a hundred"},
    {"few-many:1000", "a thousand"},
    {"turned", "the boxes of n triangles against those of the same surface turned"},
    {"static90", "filters: nine in ten are static and refuse each other"},
    {"groups", "filters: ten groups, each of which meets itself alone"},
    {"open", "boxes that only touch do not pair"},
    {"ids", "twenty boxes each have an id, and do not pair"},
    {"tolerance", "boxes pair that are nearly as far apart"},
    {"neighbours", "offsets and sorted indices of each box"},
    {"neighbours:one", "the same, each pair once"},
    {"index:load", "an index loaded, beside making it"},
    {"index:ask", "n / 10 boxes asked about in an index of n"},
    {"integers", "boxes of integers beside float ones"},
    {"U64", "double boxes beside float ones"},
    {"S64", "the same"},
    {"C64", "the same"},
    {"flat64", "of doubles that share ends, beside floats: rectangles in a plane"},
    {"voxels64", "a third of the cubes of a lattice"},
    {"parcels64", "a plane cut at whole numbers"},
    {"cents64", "the same at hundredths, which binary numbers round"},
    {"mesh64", "the triangles of a turned surface"},
    {"flat64:two", "one half against the other"},
    {"voxels64:two", "the same"},
    {"cents64:two", "the same"},
    {"mesh64:two", "the same"},
};

}  // namespace

std::vector<CaseText> sets_case_texts() {
  return texts_of(cases);
}

void run_sets_suite(const Options& options, Report& report, Progress& progress) {
  for (const std::size_t n : options.sizes_or({10000}, {1000, 10000, 100000, 1000000}))
    for (const auto& [name, description] : cases)
      if (options.wants_case(name)) run_case(name, n, options, report, progress);
}

}  // namespace boxstream::bench
