// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <charconv>
#include <stdexcept>
#include <string_view>

#include "inputs/recipe.hpp"

namespace boxstream::bench {

namespace {

constexpr std::string_view place_names[] = {"uniform", "clusters", "shell", "lattice", "diagonal", "crossing", "point"};
constexpr std::string_view order_names[] = {"shuffled", "in_parts", "ascending", "descending"};

[[noreturn]] void refuse(std::string_view what) {
  throw std::invalid_argument(fmt::format("not a recipe, at '{}'", what));
}

/// Takes the text up to `separator`, or all of it, away from `rest`.
std::string_view take(std::string_view& rest, char separator) {
  const std::size_t end = rest.find(separator);
  const std::string_view word = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  return word;
}

template <class Number>
Number number(std::string_view text, Number lowest, Number highest) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= lowest && value <= highest)) refuse(text);
  return value;
}

template <std::size_t N>
int name_index(std::string_view text, const std::string_view (&names)[N]) {
  for (std::size_t i = 0; i < N; ++i)
    if (names[i] == text) return static_cast<int>(i);
  refuse(text);
}

void read_triple(std::string_view text, double (&values)[3]) {
  for (double& value : values) value = number(take(text, ':'), -30.0, 30.0);
  if (!text.empty()) refuse(text);
}

Part parse_part(std::string_view text) {
  Part part;
  while (!text.empty()) {
    std::string_view value = take(text, ',');
    const std::string_view key = take(value, '=');
    if (key == "weight")
      part.weight = number(value, 1, 1000000);
    else if (key == "place")
      part.place = static_cast<Place>(name_index(value, place_names));
    else if (key == "groups")
      part.groups = number(value, 1, 1000000);
    else if (key == "extent")
      read_triple(value, part.extent);
    else if (key == "size")
      read_triple(value, part.size);
    else if (key == "decades")
      part.decades = number(value, 0.0, 30.0);
    else if (key == "alike")
      part.alike = number(value, 0, 1) == 1;
    else if (key == "copies")
      part.copies = number(value, 1, 1000000);
    else if (key == "snap")
      part.snap = number(value, 0.0, 1e6);
    else if (key == "pieces")
      part.pieces = number(value, 1, 1000000);
    else if (key == "lean")
      part.lean = number(value, 0.0, 1.0);
    else if (key == "jitter")
      part.jitter = number(value, 0.0, 1.0);
    else if (key == "levels")
      part.levels = number(value, 1, 100);
    else if (key == "shrink")
      part.shrink = number(value, 0.0, 30.0);
    else
      refuse(key);
  }
  return part;
}

/// Whatever a plain part does not have.
std::string text_of_more(const Part& p) {
  std::string text;
  const auto add = [&](std::string_view name, auto value) {
    if (value != 0) text += fmt::format(",{}={}", name, value);
  };
  add("pieces", p.pieces);
  add("lean", p.lean);
  add("jitter", p.jitter);
  add("levels", p.levels);
  add("shrink", p.shrink);
  return text;
}

}  // namespace

std::string to_text(const Recipe& recipe) {
  std::string text = fmt::format("n={},seed={},order={},axis={}", recipe.n, recipe.seed,
                                 order_names[static_cast<std::size_t>(recipe.order)], recipe.axis);
  for (const Part& p : recipe.parts) {
    text +=
        fmt::format(";weight={},place={},groups={},extent={}:{}:{},size={}:{}:{},decades={},alike={},copies={},snap={}",
                    p.weight, place_names[static_cast<std::size_t>(p.place)], p.groups, p.extent[0], p.extent[1],
                    p.extent[2], p.size[0], p.size[1], p.size[2], p.decades, p.alike ? 1 : 0, p.copies, p.snap);
    text += text_of_more(p);
  }
  return text;
}

Recipe parse_recipe(const std::string& text) {
  Recipe recipe;
  std::string_view rest = text;
  std::string_view head = take(rest, ';');
  while (!head.empty()) {
    std::string_view value = take(head, ',');
    const std::string_view key = take(value, '=');
    if (key == "n")
      recipe.n = number<std::size_t>(value, 1, 100000000);
    else if (key == "seed")
      recipe.seed = number<std::uint64_t>(value, 0, ~std::uint64_t{0});
    else if (key == "order")
      recipe.order = static_cast<Order>(name_index(value, order_names));
    else if (key == "axis")
      recipe.axis = number(value, 0, 2);
    else
      refuse(key);
  }
  while (!rest.empty()) recipe.parts.push_back(parse_part(take(rest, ';')));
  if (recipe.parts.empty()) refuse(text);
  return recipe;
}

}  // namespace boxstream::bench
