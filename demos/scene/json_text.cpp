// SPDX-License-Identifier: MIT
#include "scene/json_text.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "scene/scene_error.hpp"

namespace boxstream::scenes {
namespace {

using Json = nlohmann::json;

/// Control characters as \xNN, and all bytes that are not ASCII if they may be anything.
std::string on_one_line(const std::string& text, bool only_ascii = false) {
  static const char digits[] = "0123456789abcdef";
  std::string line;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code != 0x7f && !(only_ascii && code >= 0x80)) {
      line += c;
    } else {
      line += "\\x";
      line += digits[code >> 4];
      line += digits[code & 15];
    }
  }
  return line;
}

/// Builds the document and knows where it is, so that even an error of syntax has a JSON pointer.
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
    return fail(on_one_line(reason, true));
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
  return on_one_line(file + ": " + (pointer.empty() ? "/" : pointer) + ": " + reason);
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

std::string read_text_file(const std::string& path) {
  // C files, because a C++ stream does not say why it failed.
  const auto fail = [&](int code) { throw SceneError(on_one_line(path + ": cannot be read: " + std::strerror(code))); };
  const auto close = [](std::FILE* file) { std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
  if (!file) fail(errno);
  std::string text;
  char block[65536];
  while (const std::size_t count = std::fread(block, 1, sizeof block, file.get())) text.append(block, count);
  if (std::ferror(file.get()) != 0) fail(errno);
  return text;
}

}  // namespace boxstream::scenes
