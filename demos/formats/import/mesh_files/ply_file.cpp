// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "formats/import/mesh_files/mesh_files.hpp"
#include "formats/import/mesh_files/polygons.hpp"
#include "formats/import/mesh_files/text_scan.hpp"

namespace boxstream::imports {
namespace {

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

Type type_called(std::string_view name) {
  static const std::map<std::string_view, Type> types{
      {"char", Type::i8},   {"int8", Type::i8},     {"uchar", Type::u8},   {"uint8", Type::u8},
      {"short", Type::i16}, {"int16", Type::i16},   {"ushort", Type::u16}, {"uint16", Type::u16},
      {"int", Type::i32},   {"int32", Type::i32},   {"uint", Type::u32},   {"uint32", Type::u32},
      {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64}};
  const auto found = types.find(name);
  if (found == types.end()) throw std::runtime_error("a property of an unknown type: " + quoted(name));
  return found->second;
}

struct Property {
  std::string_view name;
  std::optional<Type> count;  // of a list
  Type type;
};

struct Element {
  std::string_view name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  std::string_view format;
  std::vector<Element> elements;
};

Property property_in(TextScan& words) {
  Property property{"", std::nullopt, Type::i32};
  std::string_view type = words.word();
  if (type == "list") {
    property.count = type_called(words.word());
    type = words.word();
  }
  property.type = type_called(type);
  property.name = words.word();
  return property;
}

/// Up to "end_header"; the scan is then at the first byte of the elements.
Header read_header(TextScan& scan) {
  Header header;
  const std::string_view magic = TextScan(scan.line()).word();
  if (magic != "ply" && magic != "PLY") throw std::runtime_error("does not begin with \"ply\"");
  while (!scan.at_end()) {
    TextScan words(scan.line());
    const std::string_view word = words.word();
    if (word == "end_header") return header;
    if (word == "format") header.format = words.word();
    if (word == "element") {
      const std::string_view name = words.word();
      const std::optional<std::int64_t> count = integer_in(words.word());
      if (!count || *count < 0) throw std::runtime_error("an element without a number: " + quoted(name));
      header.elements.push_back({name, static_cast<std::size_t>(*count), {}});
    }
    if (word == "property" && !header.elements.empty()) header.elements.back().properties.push_back(property_in(words));
  }
  throw std::runtime_error("a header without end");
}

/// The numbers behind the header, in any of the three formats.
class Numbers {
 public:
  Numbers(std::string_view format, std::string_view bytes)
      : is_text_(format == "ascii"), is_turned_(format == "binary_big_endian"), text_(bytes), bytes_(bytes) {
    if (!is_text_ && !is_turned_ && format != "binary_little_endian")
      throw std::runtime_error("an unknown format: " + quoted(format));
  }

  double next(Type type) {
    if (!is_text_) return binary(type);
    const std::string_view word = text_.word();
    if (word.empty()) throw std::runtime_error("cut off");
    const std::optional<double> number = number_in(word);
    if (!number) throw std::runtime_error("no number where one should be: " + quoted(word));
    return *number;
  }

 private:
  template <class T>
  double binary_as() {
    if (bytes_.size() < sizeof(T)) throw std::runtime_error("cut off");
    char bytes[sizeof(T)];
    std::memcpy(bytes, bytes_.data(), sizeof bytes);
    bytes_.remove_prefix(sizeof bytes);
    if (is_turned_ != (std::endian::native == std::endian::big)) std::reverse(bytes, bytes + sizeof bytes);
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }
  double binary(Type type) {
    switch (type) {
      case Type::i8:
        return binary_as<std::int8_t>();
      case Type::u8:
        return binary_as<std::uint8_t>();
      case Type::i16:
        return binary_as<std::int16_t>();
      case Type::u16:
        return binary_as<std::uint16_t>();
      case Type::i32:
        return binary_as<std::int32_t>();
      case Type::u32:
        return binary_as<std::uint32_t>();
      case Type::f32:
        return binary_as<float>();
      case Type::f64:
        break;
    }
    return binary_as<double>();
  }

  bool is_text_;
  bool is_turned_;
  TextScan text_;
  std::string_view bytes_;
};

class Body {
 public:
  Body(const Header& header, std::string_view bytes) : numbers_(header.format, bytes), faces_(mesh_) {
    for (const Element& element : header.elements) read(element);
    faces_.finish();
  }

  RawMesh take() { return std::move(mesh_); }

 private:
  void read(const Element& element) {
    if (element.count != 0 && element.properties.empty())
      throw std::runtime_error("an element without properties: " + quoted(element.name));
    if (element.name == "vertex") require_coordinates(element);
    for (std::size_t i = 0; i < element.count; ++i) try {
        read_one(element);
      } catch (const std::runtime_error& error) {
        throw std::runtime_error(quoted(element.name) + " " + std::to_string(i) + " of " +
                                 std::to_string(element.count) + ": " + error.what());
      }
  }

  static void require_coordinates(const Element& element) {
    for (const char* name : {"x", "y", "z"}) {
      const auto is_it = [name](const Property& property) { return property.name == name && !property.count; };
      if (std::none_of(element.properties.begin(), element.properties.end(), is_it))
        throw std::runtime_error("vertices without a property " + quoted(name));
    }
  }

  void read_one(const Element& element) {
    std::array<double, 3> place{};
    for (const Property& property : element.properties) {
      if (property.count) {
        read_list(property);
        if (element.name == "tristrips") add_strips();
        if (element.name == "face" && property.name.starts_with("vertex_ind")) add_polygon();
      } else {
        const double value = numbers_.next(property.type);
        for (std::size_t d = 0; d < 3; ++d)
          if (property.name == std::string_view("xyz").substr(d, 1)) place[d] = value;
      }
    }
    if (element.name == "vertex") mesh_.vertices.push_back(place);
  }

  /// Grows with what is there: a count may say anything.
  void read_list(const Property& property) {
    const double count = numbers_.next(*property.count);
    if (!(count >= 0) || count != std::floor(count))
      throw std::runtime_error("a list of " + std::to_string(count) + " numbers");
    list_.clear();
    for (double i = 0; i < count; ++i) list_.push_back(numbers_.next(property.type));
  }

  static std::uint32_t corner(double number) {
    if (!(number >= 0) || number > std::numeric_limits<std::uint32_t>::max() || number != std::floor(number))
      throw std::runtime_error("a vertex that is not there");
    return static_cast<std::uint32_t>(number);
  }

  void add_strips() {
    std::size_t first = 0;
    for (std::size_t i = 0; i < list_.size(); ++i) {
      if (list_[i] < 0) {
        first = i + 1;
      } else if (i >= first + 2) {
        const std::uint32_t a = corner(list_[i - 2]), b = corner(list_[i - 1]), c = corner(list_[i]);
        const bool is_turned = (i - first) % 2 != 0;
        corners_.assign({is_turned ? b : a, is_turned ? a : b, c});
        faces_.add(corners_);
      }
    }
  }

  void add_polygon() {
    corners_.clear();
    for (const double number : list_) corners_.push_back(corner(number));
    faces_.add(corners_);
  }

  Numbers numbers_;
  RawMesh mesh_;
  Polygons faces_;
  std::vector<double> list_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

RawMesh read_ply(std::string_view bytes) {
  TextScan scan(TextScan::without_mark(bytes));
  const Header header = read_header(scan);
  return Body(header, scan.rest()).take();
}

}  // namespace boxstream::imports
