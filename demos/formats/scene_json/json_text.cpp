// SPDX-License-Identifier: MIT
#include "formats/scene_json/json_text.hpp"

#include <charconv>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "base/read_file.hpp"
#include "base/words.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::scenes {
namespace {

using Json = nlohmann::json;

/// Builds the document and follows the place in it, so that even an error of syntax has a JSON pointer.
class Builder {
 public:
  using number_integer_t = Json::number_integer_t;
  using number_unsigned_t = Json::number_unsigned_t;
  using number_float_t = Json::number_float_t;
  using string_t = Json::string_t;
  using binary_t = Json::binary_t;

  explicit Builder(const std::string& file) : file_(file) {}

  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(number_integer_t value) { return put(value); }
  bool number_unsigned(number_unsigned_t value) { return put(value); }
  bool number_float(number_float_t value, const string_t&) { return put(value); }
  bool string(string_t& value) { return put(std::move(value)); }
  bool binary(binary_t&) { return fail("binary data"); }

  bool start_object(std::size_t) { return open(Json::object()); }
  bool end_object() { return close(); }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool end_array() { return close(); }

  bool key(string_t& name) {
    stack_.back().key = name;
    if (stack_.back().node->contains(name)) return fail("key given twice");
    return true;
  }

  bool parse_error(std::size_t, const std::string& token, const Json::exception& error) {
    if (dynamic_cast<const Json::out_of_range*>(&error) != nullptr) return fail("number out of range: " + token);
    std::string reason = error.what();
    const std::size_t end_of_tag = reason.find("] ");
    if (reason.starts_with("[json.exception") && end_of_tag != std::string::npos) reason.erase(0, end_of_tag + 2);
    return fail(reason);
  }

  Json take() { return std::move(root_); }

 private:
  static constexpr std::size_t max_depth = 32;

  struct Level {
    Json* node;
    std::string key;
  };

  [[noreturn]] bool fail(const std::string& reason) const {
    std::string pointer;
    for (const Level& level : stack_) {
      if (level.node->is_array()) {
        pointer = child_pointer(pointer, std::to_string(level.node->size()));
      } else if (!level.key.empty()) {
        pointer = child_pointer(pointer, level.key);
      }
    }
    throw SceneError(error_line(file_, pointer, reason));
  }

  Json* place(Json value) {
    if (stack_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    Level& top = stack_.back();
    if (top.node->is_array()) {
      top.node->push_back(std::move(value));
      return &top.node->back();
    }
    return &((*top.node)[top.key] = std::move(value));
  }

  template <class T>
  bool put(T&& value) {
    place(Json(std::forward<T>(value)));
    if (!stack_.empty()) stack_.back().key.clear();
    return true;
  }

  bool open(Json value) {
    if (stack_.size() == max_depth) return fail("nested too deeply");
    // A container counts as an element of its parent only when it is closed, so that pointers name the right index;
    // it is kept aside until then.
    open_.push_back(std::make_unique<Json>(std::move(value)));
    stack_.push_back({open_.back().get(), {}});
    return true;
  }

  bool close() {
    Json done = std::move(*open_.back());
    open_.pop_back();
    stack_.pop_back();
    return put(std::move(done));
  }

  const std::string& file_;
  Json root_;
  std::vector<std::unique_ptr<Json>> open_;
  std::vector<Level> stack_;
};

}  // namespace

std::string error_line(const std::string& file, const std::string& pointer, const std::string& reason) {
  return files::printable(file + ": " + (pointer.empty() ? "/" : pointer) + ": " + reason);
}

std::string with_name(const std::string& line, const std::string& file, const nlohmann::json& document) {
  struct List {
    const char *key, *name, *what;
  };
  for (const List& list : {List{"bodies", "name", "body"}, List{"joints", "a", "joint of body"}}) {
    const std::string start = error_line(file, std::string("/") + list.key + "/", "");
    const std::string place = start.substr(0, start.size() - 2);  // without the end of a pointer
    std::size_t index = 0;
    if (!line.starts_with(place) ||
        std::from_chars(line.data() + place.size(), line.data() + line.size(), index).ec != std::errc())
      continue;
    return line + files::printable(std::string(" (") + list.what + " \"" +
                                   document.at(list.key).at(index).at(list.name).get<std::string>() + "\")");
  }
  return line;
}

std::string child_pointer(const std::string& pointer, const std::string& key) {
  std::string child = pointer + '/';
  for (const char c : key) {
    if (c == '~') {
      child += "~0";
    } else if (c == '/') {
      child += "~1";
    } else {
      child += c;
    }
  }
  return child;
}

nlohmann::json parse_json(const std::string& text, const std::string& file) {
  Builder builder(file);
  Json::sax_parse(text, &builder);
  return builder.take();
}

std::string read_text_file(const std::string& path) try {
  return files::read_file(path, files::most_of_text);
} catch (const files::BadFile& error) {
  throw SceneError(files::printable(path + ": cannot be read: " + error.reason()));
}

}  // namespace boxstream::scenes
