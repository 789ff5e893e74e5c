// SPDX-License-Identifier: MIT
#include "formats/scene_json/old_words.hpp"

#include <algorithm>
#include <map>

namespace boxstream::scenes {
namespace {

using Json = nlohmann::json;

class Renewal {
 public:
  explicit Renewal(const std::map<std::string, std::string>& words) : words_(words) {}

  /// The name of a member of an object.
  void key(Json& object, const std::string& old) {
    const std::string& now = words_.at(old);
    if (!object.is_object() || !object.contains(old) || object.contains(now)) return;
    object[now] = std::move(object[old]);
    object.erase(old);
    tell(old);
  }

  /// What a member says, if it is one of `olds`.
  void value(Json& word, const std::vector<std::string>& olds) {
    if (!word.is_string()) return;
    const std::string old = word.get<std::string>();
    if (std::find(olds.begin(), olds.end(), old) == olds.end()) return;
    word = words_.at(old);
    tell(old);
  }

  std::vector<std::string> told;

 private:
  void tell(const std::string& old) {
    const std::string line = "\"" + old + "\" is \"" + words_.at(old) + "\" now";
    if (std::find(told.begin(), told.end(), line) == told.end()) told.push_back(line);
  }

  const std::map<std::string, std::string>& words_;
};

/// Calls `renew` with each element of a list of the document.
template <class Renew>
void for_each_of(Json& scene, const char* list, const Renew& renew) {
  if (!scene.is_object() || !scene.contains(list) || !scene[list].is_array()) return;
  for (Json& item : scene[list]) renew(item);
}

}  // namespace

std::vector<std::string> renew_words(Json& scene) {
  static const std::map<std::string, std::string> words{{"apart", "exclusions"},      {"kicks", "impulses"},
                                                        {"leaving", "out_of_bounds"}, {"observers", "monitors"},
                                                        {"rain", "respawn"},          {"swirl", "vortex"}};
  Renewal renewal(words);
  renewal.key(scene, "apart");
  for_each_of(scene, "fields", [&](Json& field) {
    if (field.is_object() && field.contains("type")) renewal.value(field["type"], {"swirl", "kicks"});
  });
  for_each_of(scene, "generators", [&](Json& generator) {
    if (!generator.is_object() || !generator.contains("type")) return;
    if (generator["type"] == "grid") renewal.key(generator, "swirl");
    renewal.value(generator["type"], {"rain"});
  });
  if (scene.is_object() && scene.contains("effects"))
    for (const char* const wish : {"require", "forbid"})
      for_each_of(scene["effects"], wish, [&](Json& effect) {
        renewal.value(effect, {"apart", "kicks", "leaving", "observers", "rain", "swirl"});
      });
  return std::move(renewal.told);
}

}  // namespace boxstream::scenes
