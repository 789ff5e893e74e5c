// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace boxstream::view_test {

/// A .glb file, read back. Throws std::runtime_error or a JSON exception where it is broken.
class GlbReader {
 public:
  explicit GlbReader(const std::string& bytes);

  const nlohmann::json& document() const { return document_; }
  std::vector<float> floats(std::size_t accessor) const;

  /// What the animation makes of one property of a node at a time; what the node has where it has no channel.
  std::vector<float> at(std::size_t node, const std::string& path, float seconds) const;
  bool is_animated(std::size_t node, const std::string& path) const;
  /// Times of its keyframes.
  std::vector<float> times(std::size_t node, const std::string& path) const;

  /// The node with this name.
  std::size_t node(const std::string& name) const;

 private:
  const nlohmann::json* sampler(std::size_t node, const std::string& path) const;

  nlohmann::json document_;
  std::string binary_;
  std::map<std::pair<std::size_t, std::string>, std::size_t> samplers_;
  std::map<std::string, std::size_t> nodes_;
};

}  // namespace boxstream::view_test
