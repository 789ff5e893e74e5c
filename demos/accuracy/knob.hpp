// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace boxstream::scenes {
struct Scene;
}

namespace boxstream::accuracy {

/// Says in one line what is wrong with a knob.
class BadKnob : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A value of a scene file that trades accuracy for time, and what to set it to.
struct Knob {
  std::string name;                    ///< as the user wrote it
  std::string pointer;                 ///< where it is in the file (RFC 6901); "*" is every element of a list
  std::vector<nlohmann::json> values;  ///< null takes the key away
  std::vector<std::string> labels{};   ///< of the values, where they are no names for themselves
  bool is_rare = false;                ///< seldom helps: where settings are sought, it is turned alone
};

/// What a value of this knob is called.
std::string text_of(const Knob& knob, const nlohmann::json& value);

/// "NAME=VALUE,VALUE...". NAME is a pointer ("/materials/steel/friction") or one of knob_names(). A value is a number,
/// a fraction ("1/60"), true, false, or else text. Throws BadKnob.
Knob parse_knob(const std::string& text);

/// Keys of the blocks time, world and solver that need no pointer: "substeps" is "/time/substeps".
std::vector<std::string> knob_names();

/// One value for each knob.
using Setting = std::vector<nlohmann::json>;

/// All combinations; the values of the last knob follow each other.
std::vector<Setting> grid(const std::vector<Knob>& knobs);

/// "substeps=2 iterations=10".
std::string label(const std::vector<Knob>& knobs, const Setting& setting);

/// The scene with these values in place. Blocks that are not there are made. Throws BadKnob for a pointer that leads
/// through something that is neither object nor array, or past the end of an array.
nlohmann::json with(nlohmann::json scene, const std::vector<Knob>& knobs, const Setting& setting);

/// Whether the scene has these values by itself, to five digits: in its file or, for knob_names(), by default. `scene`
/// is what `document` says.
bool is_own(const nlohmann::json& document, const scenes::Scene& scene, const std::vector<Knob>& knobs,
            const Setting& setting);

}  // namespace boxstream::accuracy
