// SPDX-License-Identifier: MIT
#include "formats/import/ply_strips.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

namespace boxstream::imports {
namespace {

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

Type type_called(const std::string& name) {
  static const std::map<std::string, Type> types{
      {"char", Type::i8},   {"int8", Type::i8},     {"uchar", Type::u8},   {"uint8", Type::u8},
      {"short", Type::i16}, {"int16", Type::i16},   {"ushort", Type::u16}, {"uint16", Type::u16},
      {"int", Type::i32},   {"int32", Type::i32},   {"uint", Type::u32},   {"uint32", Type::u32},
      {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64}};
  const auto found = types.find(name);
  if (found == types.end()) throw std::runtime_error("a property of an unknown type");
  return found->second;
}

struct Property {
  std::string name;
  std::optional<Type> count;  // of a list
  Type type;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  std::string format;
  std::vector<Element> elements;
};

constexpr int most_lines = 1000;  // of a header

bool names_strips(std::istream& in) {
  std::string line;
  for (int i = 0; i < most_lines && std::getline(in, line) && !line.starts_with("end_header"); ++i)
    if (line.starts_with("element tristrips")) return true;
  return false;
}

/// Up to "end_header"; the stream is then at the first byte of the elements.
Header read_header(std::istream& in) {
  Header header;
  std::string line;
  for (int i = 0; i < most_lines && std::getline(in, line); ++i) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "end_header") return header;
    if (word == "format") words >> header.format;
    if (word == "element") {
      Element element;
      words >> element.name >> element.count;
      if (!words) throw std::runtime_error("an element without a number");
      header.elements.push_back(std::move(element));
    }
    if (word == "property" && !header.elements.empty()) {
      Property property{"", std::nullopt, Type::i32};
      words >> word;
      if (word == "list") {
        words >> word;
        property.count = type_called(word);
        words >> word;
      }
      property.type = type_called(word);
      words >> property.name;
      header.elements.back().properties.push_back(std::move(property));
    }
  }
  throw std::runtime_error("a header without end");
}

class Numbers {
 public:
  Numbers(const std::string& format, std::istream& in)
      : text_(format == "ascii"), turned_(format == "binary_big_endian"), in_(in) {
    if (!text_ && !turned_ && format != "binary_little_endian") throw std::runtime_error("an unknown format");
  }

  double next(Type type) {
    if (!text_) return binary(type);
    double value = 0;
    if (!(in_ >> value)) throw std::runtime_error("cut off, or no number where one should be");
    return value;
  }

 private:
  template <class T>
  double binary_as() {
    char bytes[sizeof(T)];
    if (!in_.read(bytes, sizeof bytes)) throw std::runtime_error("cut off");
    if (turned_ != (std::endian::native == std::endian::big)) std::reverse(bytes, bytes + sizeof bytes);
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
      default:
        return binary_as<double>();
    }
  }

  bool text_;
  bool turned_;
  std::istream& in_;
};

class Body {
 public:
  Body(const Header& header, std::istream& in) : numbers_(header.format, in) {
    for (const Element& element : header.elements)
      for (std::size_t i = 0; i < element.count; ++i) add(element);
    for (const auto& triangle : raw_.triangles)
      for (const std::uint32_t corner : triangle)
        if (corner >= raw_.vertices.size()) throw std::runtime_error("a triangle with a vertex that is not there");
  }

  RawMesh take() { return std::move(raw_); }

 private:
  void add(const Element& element) {
    if (element.properties.empty()) throw std::runtime_error("an element without properties");
    std::array<float, 3> place{};
    for (const Property& property : element.properties) {
      if (property.count) {
        read_list(property);
        if (element.name == "tristrips") add_strips();
        if (element.name == "face" && property.name.starts_with("vertex_ind")) add_polygon();
      } else {
        const double value = numbers_.next(property.type);
        for (std::size_t d = 0; d < 3; ++d)
          if (property.name == std::string(1, "xyz"[d])) place[d] = static_cast<float>(value);
      }
    }
    if (element.name == "vertex") raw_.vertices.push_back(place);
  }

  /// Grows with what is there: a count may say anything.
  void read_list(const Property& property) {
    const double count = numbers_.next(*property.count);
    list_.clear();
    for (double i = 0; i < count; ++i) list_.push_back(numbers_.next(property.type));
  }

  static std::uint32_t corner(double number) {
    if (!(number >= 0) || number > std::numeric_limits<std::uint32_t>::max())
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
        if ((i - first) % 2 == 0)
          raw_.triangles.push_back({a, b, c});
        else
          raw_.triangles.push_back({b, a, c});
      }
    }
  }

  void add_polygon() {
    for (std::size_t i = 2; i < list_.size(); ++i)
      raw_.triangles.push_back({corner(list_[0]), corner(list_[i - 1]), corner(list_[i])});
  }

  Numbers numbers_;
  RawMesh raw_;
  std::vector<double> list_;
};

}  // namespace

std::optional<RawMesh> read_ply_strips(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!names_strips(in)) return std::nullopt;
  in.clear();
  in.seekg(0);
  const Header header = read_header(in);
  return Body(header, in).take();
}

}  // namespace boxstream::imports
