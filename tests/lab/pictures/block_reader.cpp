// SPDX-License-Identifier: MIT
#include "block_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace boxstream::view_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::int64_t with_sign(std::uint32_t coded) {
  return coded % 2 == 0 ? std::int64_t{coded} / 2 : -(std::int64_t{coded} + 1) / 2;
}

}  // namespace

BlockReader::BlockReader(const std::string& block, std::size_t objects, std::size_t nodes, std::size_t turning)
    : block_(block),
      places_{true, 3 * (objects + nodes)},
      rotations_{true, 4 * turning},
      boxes_{true, 6 * objects},
      islands_{false, objects},
      moods_{false, objects} {}

void BlockReader::leap(Series& series, std::size_t i) {
  const std::uint32_t coded = leb128();
  const double value = coded == 1U << 28 ? nan : static_cast<double>(with_sign(coded));
  const double way = value - series.at[i];
  series.speed[i] = std::isnan(way) ? 0 : way;
  series.at[i] = value;
}

const std::vector<double>& BlockReader::numbers(Series& series) {
  if (series.at.empty()) {
    series.at.assign(series.count, nan);
    series.speed.assign(series.count, 0);
    for (std::size_t i = 0; i < series.count; ++i) leap(series, i);
    return series.at;
  }
  std::vector<std::size_t> leaps;
  for (std::size_t i = 0; i < series.count; ++i) {
    const auto byte = static_cast<std::uint8_t>(block_.at(at_++));
    if (byte == 255) {
      leaps.push_back(i);
      continue;
    }
    const auto step = static_cast<double>(with_sign(byte));
    const bool goes = series.goes_on && std::fabs(series.speed[i]) >= 1;
    series.at[i] += step + (goes ? series.speed[i] : 0);
    series.speed[i] += step / 2;
    // To whole sixteenths, towards 0.
    if (step == 0 && !goes) series.speed[i] = std::trunc(series.speed[i] * 16 / 2) / 16;
  }
  for (const std::size_t i : leaps) leap(series, i);
  return series.at;
}

std::uint32_t BlockReader::leb128() {
  std::uint32_t value = 0;
  for (int shift = 0;; shift += 7) {
    const auto byte = static_cast<std::uint8_t>(block_.at(at_++));
    value |= std::uint32_t{byte & 0x7FU} << shift;
    if (byte < 0x80) return value;
  }
}

std::vector<std::size_t> BlockReader::places() {
  std::vector<std::size_t> list(leb128());
  std::size_t last = 0;
  for (std::size_t& place : list) place = last += leb128();
  return list;
}

std::vector<Pair> BlockReader::new_pairs() {
  std::vector<Pair> list(leb128());
  Pair last{0, 0};
  for (Pair& pair : list) {
    pair.a = last.a + leb128();
    pair.b = (pair.a == last.a ? last.b : pair.a) + leb128();
    last = pair;
  }
  return list;
}

void BlockReader::read_pairs(Frame& frame) {
  std::map<Pair, bool> held;
  for (std::size_t i = 0; i < pairs_.size(); ++i) held[pairs_[i]] = touching_[i];
  for (const std::size_t place : places()) held.erase(pairs_.at(place));
  for (const Pair& pair : new_pairs()) held[pair] = false;
  for (const auto& [pair, touches] : held) {
    frame.pairs.push_back(pair);
    frame.touching.push_back(touches);
  }
  for (const std::size_t place : places()) frame.touching.at(place) = !frame.touching.at(place);
  frame.contacts = contacts(frame.pairs);
  pairs_ = frame.pairs;
  touching_ = frame.touching;
}

std::optional<std::vector<BlockReader::Contact>> BlockReader::contacts(const std::vector<Pair>& pairs) {
  const std::uint32_t coded = leb128();
  if (coded == 0) return std::nullopt;
  std::vector<Contact> list(coded - 1);
  std::size_t place = 0;
  for (Contact& contact : list) {
    contact.objects = pairs.at(place += leb128());
    for (std::int64_t& x : contact.place) x = with_sign(leb128());
    for (std::uint32_t& x : contact.normal) x = leb128();
  }
  return list;
}

BlockReader::Frame BlockReader::next() {
  Frame frame;
  frame.places = numbers(places_);
  frame.rotations = numbers(rotations_);
  frame.boxes = numbers(boxes_);
  frame.islands = numbers(islands_);
  frame.moods = numbers(moods_);
  read_pairs(frame);
  return frame;
}

}  // namespace boxstream::view_test
