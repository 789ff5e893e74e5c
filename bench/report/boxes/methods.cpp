// SPDX-License-Identifier: MIT
#include "boxes/methods.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "boxes/fat_boxes.hpp"
#include "peers/ours.hpp"

namespace boxstream::report {
namespace {

Method make_method(const std::string& name, const nlohmann::json& settings) {
  Method method;
  method.series = name;
  method.most = settings.value("most", std::size_t{0});
  if (name == "detector") {
    method.peer = bench::make_detector(nullptr);
  } else if (name == "world") {
    method.peer = bench::make_world(nullptr);
  } else if (name == "rooms" || name == "rooms-tested") {
    method.x = settings.at("room").get<double>();
    method.setting = fmt::format("{:g} %", 100 * method.x);
    method.superset = name == "rooms";
    method.peer = std::make_unique<FatBoxes>(method.x, !method.superset);
  } else {
    std::string known = "detector, world, rooms, rooms-tested";
    for (bench::PeerConfig& config : bench::make_peers(1)) {
      known += ", " + config.name;
      if (config.name != name) continue;
      method.known_difference = config.known_difference;
      method.peer = std::move(config.peer);
      return method;
    }
    throw std::invalid_argument(fmt::format("no method \"{}\"; there are {}", name, known));
  }
  return method;
}

}  // namespace

std::vector<Method> read_methods(const nlohmann::json& list) {
  std::vector<Method> methods;
  for (const nlohmann::json& entry : list) {
    const nlohmann::json settings = entry.is_string() ? nlohmann::json{{"way", entry}} : entry;
    methods.push_back(make_method(settings.at("way").get<std::string>(), settings));
  }
  if (methods.empty()) throw std::invalid_argument("no methods");
  return methods;
}

}  // namespace boxstream::report
