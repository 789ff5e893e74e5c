// SPDX-License-Identifier: MIT
#include "formats/scene_json/json_node.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/words.hpp"
#include "formats/scene_json/json_text.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::scenes {
namespace {

template <class T>
void check_range(const Node& node, T value, T low, T high, bool open_low) {
  if (value < low || (open_low && value == low))
    node.fail(fmt::format("must be {} {}, got {}", open_low ? "greater than" : "at least", low, value));
  if (value > high) node.fail(fmt::format("must be at most {}, got {}", high, value));
}

std::string join(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

void Node::fail(const std::string& reason) const {
  throw SceneError(error_line(*file_, pointer_, reason));
}

void Node::wrong_type(const char* expected) const {
  fail(fmt::format("expected {}, got {}", expected,
                   value_->is_null() ? "null" : std::string("a value of type ") + value_->type_name()));
}

Node Node::child(const std::string& key) const {
  return Node(value_->at(key), child_pointer(pointer_, key), *file_);
}

double Node::number(Range range) const {
  if (!value_->is_number()) wrong_type("a number");
  const auto value = value_->get<double>();
  if (!std::isfinite(value)) fail("not a finite number");
  check_range(*this, value, range.low, range.high, range.open_low);
  return value;
}

std::int64_t Node::whole(std::int64_t low, std::int64_t high) const {
  if (value_->is_number_float()) {
    const auto value = value_->get<double>();
    if (value != std::floor(value)) wrong_type("a whole number");
    check_range(*this, value, static_cast<double>(low), static_cast<double>(high), false);
    return static_cast<std::int64_t>(value);
  }
  if (!value_->is_number_integer()) wrong_type("a whole number");
  if (value_->is_number_unsigned() && high >= 0)
    check_range<std::uint64_t>(*this, value_->get<std::uint64_t>(), 0, static_cast<std::uint64_t>(high), false);
  const auto value = value_->get<std::int64_t>();
  check_range<std::int64_t>(*this, value, low, high, false);
  return value;
}

int Node::integer(int low, int high) const {
  return static_cast<int>(whole(low, high));
}

std::uint64_t Node::count() const {
  return static_cast<std::uint64_t>(whole(0, (std::int64_t{1} << 53) - 1));
}

bool Node::boolean() const {
  if (!value_->is_boolean()) wrong_type("true or false");
  return value_->get<bool>();
}

std::string Node::text() const {
  if (!value_->is_string()) wrong_type("a string");
  auto value = value_->get<std::string>();
  if (value.empty()) fail("must not be empty");
  return value;
}

std::size_t Node::choice(const std::vector<std::string>& words) const {
  const std::string word = text();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end())
    fail(fmt::format("unknown value \"{}\"{} (known: {})", word, did_you_mean(word, words), join(words)));
  return static_cast<std::size_t>(found - words.begin());
}

std::vector<Node> Node::list(std::size_t least, std::size_t most) const {
  if (!value_->is_array()) wrong_type("a list");
  const std::size_t size = value_->size();
  if (least == most && size != least) fail(fmt::format("must have {} elements, got {}", least, size));
  if (size < least) fail(fmt::format("must have at least {} elements, got {}", least, size));
  if (size > most) fail(fmt::format("must have at most {} elements, got {}", most, size));
  std::vector<Node> nodes;
  nodes.reserve(size);
  for (std::size_t i = 0; i < size; ++i)
    nodes.emplace_back((*value_)[i], child_pointer(pointer_, std::to_string(i)), *file_);
  return nodes;
}

Vec3 Node::vec3(Range range) const {
  const std::vector<Node> parts = list(3, 3);
  return {parts[0].number(range), parts[1].number(range), parts[2].number(range)};
}

std::array<double, 2> Node::pair(Range range) const {
  const std::vector<Node> parts = list(2, 2);
  const std::array<double, 2> values{parts[0].number(range), parts[1].number(range)};
  if (values[0] > values[1]) fail(fmt::format("must be in ascending order, got {} and {}", values[0], values[1]));
  return values;
}

Fields::Fields(const Node& node) : node_(node) {
  if (!node.json().is_object())
    node.fail(fmt::format("expected an object, got a value of type {}", node.json().type_name()));
}

std::optional<Node> Fields::find(const std::string& key) {
  asked_.push_back(key);
  if (!node_.json().contains(key)) return std::nullopt;
  return node_.child(key);
}

Node Fields::require(const std::string& key) {
  const std::optional<Node> found = find(key);
  if (!found) node_.fail(fmt::format("key \"{}\" is missing", key));
  return *found;
}

double Fields::number(const std::string& key, double fallback, Range range) {
  const auto found = find(key);
  return found ? found->number(range) : fallback;
}

int Fields::integer(const std::string& key, int fallback, int low, int high) {
  const auto found = find(key);
  return found ? found->integer(low, high) : fallback;
}

bool Fields::boolean(const std::string& key, bool fallback) {
  const auto found = find(key);
  return found ? found->boolean() : fallback;
}

std::string Fields::text(const std::string& key, const std::string& fallback) {
  const auto found = find(key);
  return found ? found->text() : fallback;
}

Vec3 Fields::vec3(const std::string& key, const Vec3& fallback, Range range) {
  const auto found = find(key);
  return found ? found->vec3(range) : fallback;
}

void Fields::finish() const {
  for (const auto& [key, value] : node_.json().items())
    if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
      node_.child(key).fail(fmt::format("unknown key{} (known: {})", did_you_mean(key, asked_), join(asked_)));
}

}  // namespace boxstream::scenes
