// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "formats/scene_model/scene.hpp"

namespace boxstream::scenes {

/// The range of a number. Ends belong to the range unless `open_low` excludes the lower one.
struct Range {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();
  bool open_low = false;
};

/// Above zero, for sizes, masses and steps.
inline Range positive(double high) {
  return {0, high, true};
}

/// A JSON value together with its place; every getter checks the type and says where it went wrong (SceneError).
class Node {
 public:
  Node(const nlohmann::json& value, std::string pointer, const std::string& file)
      : value_(&value), pointer_(std::move(pointer)), file_(&file) {}

  double number(Range range) const;
  /// Whole numbers may be written with a fraction of zero or an exponent, as JSON Schema has it.
  int integer(int low, int high) const;
  /// At most 2^53 - 1, which every reader of JSON keeps exactly.
  std::uint64_t count() const;
  bool boolean() const;
  /// Not empty.
  std::string text() const;
  /// One of a list of words: its index.
  std::size_t choice(const std::vector<std::string>& words) const;
  std::vector<Node> list(std::size_t least, std::size_t most) const;
  Vec3 vec3(Range range) const;
  std::array<double, 2> pair(Range range) const;

  bool is_string() const { return value_->is_string(); }
  bool is_object() const { return value_->is_object(); }
  [[noreturn]] void fail(const std::string& reason) const;
  Node child(const std::string& key) const;
  const nlohmann::json& json() const { return *value_; }
  const std::string& file() const { return *file_; }

 private:
  [[noreturn]] void wrong_type(const char* expected) const;
  std::int64_t whole(std::int64_t low, std::int64_t high) const;

  const nlohmann::json* value_;
  std::string pointer_;
  const std::string* file_;
};

/// Reads a JSON object key by key and, at the end, refuses keys that were never read.
class Fields {
 public:
  explicit Fields(const Node& node);

  std::optional<Node> find(const std::string& key);
  Node require(const std::string& key);
  const Node& node() const { return node_; }

  double number(const std::string& key, double fallback, Range range);
  double number(const std::string& key, Range range) { return require(key).number(range); }
  int integer(const std::string& key, int fallback, int low, int high);
  bool boolean(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::string& fallback);
  Vec3 vec3(const std::string& key, const Vec3& fallback, Range range);

  /// Throws SceneError for the first unknown key.
  void finish() const;

 private:
  Node node_;
  std::vector<std::string> asked_;
};

/// Makes `value` what "type" names: of the alternative whose `kind` that is, with its default values. `read` is called
/// with it and reads the other keys: it takes each alternative. Throws SceneError, with all names, if there is no such
/// kind.
template <class... T, class Read>
void read_kind(Fields& fields, std::variant<T...>& value, const Read& read) {
  using Variant = std::variant<T...>;
  constexpr void (*make[])(Variant&) = {[](Variant& v) { v.template emplace<T>(); }...};
  make[fields.require("type").choice({T::kind...})](value);
  std::visit(read, value);
}

}  // namespace boxstream::scenes
