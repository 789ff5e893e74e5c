// SPDX-License-Identifier: MIT
// Changes JSON as JSON: bytes that are changed blindly mostly give text that no parser takes.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using nlohmann::json;

void collect(json& node, std::vector<json*>& nodes) {
  nodes.push_back(&node);
  if (node.is_structured())
    for (json& part : node) collect(part, nodes);
}

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  void change(json& document, const json& other) {
    std::vector<json*> nodes, others;
    collect(document, nodes);
    json copy = other;
    collect(copy, others);
    json& node = pick_of(nodes);
    switch (below(9)) {
      case 0:
      case 1:
      case 2:
        node = value(node);
        break;
      case 3:
        node = json(pick_of(nodes));  // a copy: it may contain `node`
        break;
      case 4:
      case 5:
        node = json(pick_of(others));
        break;
      case 6:
        remove_from(node);
        break;
      case 7:
        if (node.is_array() && !node.empty()) node.push_back(json(node[below(node.size())]));
        break;
      default:
        if (node.is_object() && !others.empty()) adopt(node, pick_of(others));
    }
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }
  json& pick_of(const std::vector<json*>& nodes) { return *nodes[below(nodes.size())]; }

  json value(const json& was) {
    static const double numbers[] = {0,   -0.0, 1,    -1,    2,     3,      0.5,          1e-9,        1e-3,
                                     100, 255,  256,  1000,  1e4,   65536,  1e5,          1e6,         1e7,
                                     1e9, 1e18, 1e30, 1e100, 1e308, -1e308, -2,           -0.5,        -100,
                                     360, -360, 0.1,  1.9,   1e-30, 5e-324, 2147483647.0, 4294967296.0};
    const double number = numbers[below(std::size(numbers))];
    if (was.is_number_float() && below(2) == 0) return was.get<double>() * number;
    if (was.is_number_integer() && below(2) == 0)
      return static_cast<std::int64_t>(std::clamp(was.get<double>() * 0.5, -9e18, 9e18)) +
             static_cast<std::int64_t>(below(5));
    switch (below(8)) {
      case 0:
        return nullptr;
      case 1:
        return below(2) == 0;
      case 2:
        return "x";
      case 3:
        return json::array();
      case 4:
        return static_cast<std::int64_t>(below(2000)) - 1000;
      case 5:
        return static_cast<std::int64_t>(std::clamp(number, -9e18, 9e18));
      default:
        return number;
    }
  }

  void remove_from(json& node) {
    if (!node.is_structured() || node.empty()) return;
    auto part = node.begin();
    std::advance(part, below(node.size()));
    node.erase(part);
  }

  /// A key of another object, with its value.
  void adopt(json& node, const json& other) {
    if (!other.is_object() || other.empty()) return;
    auto part = other.begin();
    std::advance(part, below(other.size()));
    node[part.key()] = part.value();
  }

  std::minstd_rand random_;
};

json parsed(const std::uint8_t* data, std::size_t size) {
  return json::parse(data, data + size, nullptr, false);
}

std::size_t put(const json& document, std::uint8_t* data, std::size_t max_size) {
  const std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > max_size) return 0;
  std::memcpy(data, text.data(), text.size());
  return text.size();
}

std::size_t mutated(const json& first, const json& second, unsigned seed, std::uint8_t* data, std::size_t max_size) {
  json document = first;
  Mutator mutator(seed);
  for (unsigned i = 0; i <= seed % 3; ++i) mutator.change(document, second);
  return put(document, data, max_size);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  const json document = seed % 8 == 0 ? json(json::value_t::discarded) : parsed(data, size);
  if (!document.is_discarded())
    if (const std::size_t written = mutated(document, document, seed, data, max_size)) return written;
  return LLVMFuzzerMutate(data, size, max_size);
}

/// Parts of one document into another.
extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data1, std::size_t size1,
                                                 const std::uint8_t* data2, std::size_t size2, std::uint8_t* out,
                                                 std::size_t max_size, unsigned seed) {
  const json first = parsed(data1, size1), second = parsed(data2, size2);
  if (first.is_discarded() || second.is_discarded()) return 0;
  return mutated(first, second, seed, out, max_size);
}
