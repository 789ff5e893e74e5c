// SPDX-License-Identifier: MIT
#include "pictures/viewer/pair_code.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "pictures/viewer/series.hpp"

namespace boxstream::view {
namespace {

constexpr double octahedron_digits = 63;

/// Appends where each of `places`, which ascend, is as seen from the last one.
void append_places(std::string& out, const std::vector<std::uint32_t>& places) {
  append_number(out, static_cast<std::uint32_t>(places.size()));
  std::uint32_t last = 0;
  for (const std::uint32_t place : places) append_number(out, place - std::exchange(last, place));
}

void append_pairs(std::string& out, const std::vector<Pair>& pairs) {
  append_number(out, static_cast<std::uint32_t>(pairs.size()));
  Pair last{0, 0};
  for (const Pair& pair : pairs) {
    append_number(out, pair.a - last.a);
    append_number(out, pair.b - (pair.a == last.a ? last.b : pair.a));
    last = pair;
  }
}

/// A direction as a place in a square: that of an octahedron, whose lower half is folded outward.
std::array<std::uint32_t, 2> on_octahedron(const Point& n) {
  const double sum = std::max(1e-9, std::fabs(double{n[0]}) + std::fabs(double{n[1]}) + std::fabs(double{n[2]}));
  double x = n[0] / sum, y = n[1] / sum;
  if (n[2] < 0) {
    const double folded = (1 - std::fabs(y)) * (x < 0 ? -1 : 1);
    y = (1 - std::fabs(x)) * (y < 0 ? -1 : 1);
    x = folded;
  }
  const auto digit = [](double c) { return static_cast<std::uint32_t>(std::lround((c + 1) / 2 * octahedron_digits)); };
  return {digit(x), digit(y)};
}

bool is_number(const Point& p) {
  return std::all_of(p.begin(), p.end(), [](float x) { return std::isfinite(x); });
}

}  // namespace

void PairCode::restart() {
  pairs_.clear();
  touching_.clear();
  is_first_ = true;
}

/// For each pair of now, whether it touched in the frame before.
std::vector<bool> PairCode::former_touches(const Snapshot& snapshot) const {
  std::vector<bool> touched;
  std::size_t at = 0;
  for (const Pair& pair : snapshot.pairs) {
    while (at < pairs_.size() && pairs_[at] < pair) ++at;
    touched.push_back(at < pairs_.size() && !(pair < pairs_[at]) && touching_[at]);
  }
  return touched;
}

void PairCode::code_change(const Snapshot& snapshot, std::string& out) {
  std::vector<std::uint32_t> ended;
  for (std::uint32_t i = 0; i < pairs_.size(); ++i)
    if (!std::binary_search(snapshot.pairs.begin(), snapshot.pairs.end(), pairs_[i])) ended.push_back(i);
  std::vector<Pair> begun;
  std::set_difference(snapshot.pairs.begin(), snapshot.pairs.end(), pairs_.begin(), pairs_.end(),
                      std::back_inserter(begun));
  append_places(out, ended);
  append_pairs(out, begun);
}

void PairCode::code_touches(const Snapshot& snapshot, std::string& out) {
  const std::vector<bool> before = former_touches(snapshot);
  std::vector<bool> now(snapshot.pairs.size());
  for (const Contact& contact : snapshot.contacts) {
    const auto place = std::lower_bound(snapshot.pairs.begin(), snapshot.pairs.end(), contact.objects);
    if (place != snapshot.pairs.end() && !(contact.objects < *place))
      now[static_cast<std::size_t>(place - snapshot.pairs.begin())] = true;
  }
  std::vector<std::uint32_t> turned;
  for (std::uint32_t i = 0; i < now.size(); ++i)
    if (now[i] != before[i]) turned.push_back(i);
  append_places(out, turned);
  touching_ = std::move(now);
}

void PairCode::code_contacts(const Snapshot& snapshot, const std::vector<std::int32_t>& places, std::string& out) {
  std::string points;
  std::uint32_t count = 0, last = 0;
  for (const Contact& contact : snapshot.contacts) {
    const auto pair = std::lower_bound(snapshot.pairs.begin(), snapshot.pairs.end(), contact.objects);
    if (pair == snapshot.pairs.end() || contact.objects < *pair || !is_number(contact.place)) continue;
    const std::uint32_t from = snapshot.moods[pair->a] == Mood::fixed ? pair->b : pair->a;
    const auto place = static_cast<std::uint32_t>(pair - snapshot.pairs.begin());
    append_number(points, place - std::exchange(last, place));
    for (std::size_t d = 0; d < 3; ++d) {
      const double start = double{unit_} * places[3 * from + d] / Series::fine;
      const double quanta = std::clamp((contact.place[d] - start) / (contact_quantum * unit_), -1e9, 1e9);
      append_number(points, sign_last(static_cast<std::int32_t>(std::lround(quanta))));
    }
    for (const std::uint32_t digit : on_octahedron(contact.normal)) append_number(points, digit);
    ++count;
  }
  append_number(out, count + 1);
  out += points;
}

void PairCode::code(const Snapshot& snapshot, const std::vector<std::int32_t>& places, std::string& out) {
  code_change(snapshot, out);
  code_touches(snapshot, out);
  if (is_first_ || snapshot.contacts.size() <= few_contacts)
    code_contacts(snapshot, places, out);
  else
    append_number(out, 0);
  pairs_ = snapshot.pairs;
  is_first_ = false;
}

}  // namespace boxstream::view
