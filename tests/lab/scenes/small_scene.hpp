// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace boxstream::scenes_test {

/// A valid scene with at least one of everything, to be spoilt one place at a time.
inline const std::string small_scene = R"({
  "format": 1,
  "meta": {"name": "small", "about": "A bit of everything.", "source": "test", "tags": ["a", "b"]},
  "time": {"dt": 0.01, "steps": 10},
  "world": {"gravity": [0, -9.81, 0], "bounds": {"min": [-20, -5, -20], "max": [20, 20, 20]}, "seed": 9},
  "solver": {"iterations": 10, "split_impulse": true, "cache_friction": true},
  "broadphase": {"kind": "dbvt"},
  "materials": {"wood": {"friction": 0.5, "rolling": 0, "spinning": 0, "restitution": 0.1}},
  "shapes": [
    {"name": "floor", "type": "plane", "normal": [0, 1, 0], "offset": 0},
    {"name": "box", "type": "box", "half_extents": [0.5, 0.5, 0.5]},
    {"name": "ball", "type": "sphere", "radius": 0.5},
    {"name": "pill", "type": "capsule", "radius": 0.2, "height": 0.5},
    {"name": "wedge", "type": "hull", "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]},
    {"name": "hill", "type": "heightfield", "columns": 2, "rows": 2, "cell": 1, "heights": [0, 0, 0, 1]},
    {"name": "net", "type": "mesh", "vertices": [[0, 0, 0], [0, 0, 1], [1, 0, 0]], "triangles": [[0, 1, 2]]},
    {"name": "pair", "type": "compound", "children": [{"shape": "box"}, {"shape": "ball", "position": [0, 1, 0]}]}
  ],
  "bodies": [
    {"name": "ground", "shape": "floor", "type": "static", "material": "wood"},
    {"name": "one", "shape": "box", "mass": 1, "position": [0, 3, 0], "group": 1, "mask": 3},
    {"name": "two", "shape": "pair", "density": 100, "position": [3, 3, 0],
     "rotation": {"axis": [0, 0, 1], "degrees": 30}, "ccd": {"threshold": 0.5, "radius": 0.2}},
    {"name": "mover", "shape": "box", "type": "kinematic", "position": [-4, 1, 0], "velocity": [1, 0, 0]}
  ],
  "generators": [
    {"type": "container", "size": [16, 4, 16], "thickness": 1, "material": "wood"},
    {"type": "grid", "count": 4, "columns": [2, 2], "spacing": [2, 2, 2], "origin": [-5, 6, -5],
     "mix": [{"shape": "ball", "mass": 2, "scale": [0.5, 1]}]},
    {"type": "wall", "columns": 2, "rows": 2, "origin": [5, 0, 5], "brick": {"shape": "box", "mass": 1}},
    {"type": "chain", "links": 2, "anchor": [-6, 8, 5], "direction": [0, -1, 0], "pitch": 1, "end_offset": 0.5,
     "link": {"shape": "pill", "mass": 1}, "end": {"shape": "ball", "mass": 3}},
    {"type": "ragdolls", "count": 1, "columns": [1, 1], "spacing": [2, 2, 2], "origin": [5, 5, -5]},
    {"type": "pyramid", "levels": 2, "origin": [-2, 0, 6], "brick": {"shape": "box", "mass": 1}},
    {"type": "tower", "levels": 2, "around": 6, "origin": [1, 0, -6], "brick": {"shape": "box", "mass": 1}},
    {"type": "scatter", "count": 3, "origin": [-5, 9, 5], "size": [3, 3, 3], "mix": [{"shape": "ball", "mass": 1}]}
  ],
  "joints": [
    {"type": "hinge", "a": "one", "b": "two", "pivot": [1, 3, 0], "axis": [0, 0, 1], "limits": [-90, 90]},
    {"type": "ball", "a": "one", "pivot": [0, 4, 0]},
    {"type": "cone_twist", "a": "two", "b": "mover", "pivot": [0, 3, 0], "axis": [1, 0, 0],
     "swing1": 30, "swing2": 30, "twist": 10}
  ],
  "sensors": [{"name": "gate", "half_extents": [1, 1, 1], "position": [0, 1, 0]}],
  "characters": [{"name": "walker", "speed": 1, "push": 10, "path": [[0, 2, -5], [4, 2, -5]]}],
  "soft_bodies": [
    {"type": "cloth", "mass": 1, "corners": [[-3, 5, -3], [-1, 5, -3], [-3, 5, -1], [-1, 5, -1]],
     "resolution": [4, 4], "pinned": [0, 3]},
    {"type": "ball", "mass": 1, "centre": [0, 8, 4], "radius": 0.5, "resolution": 32, "pressure": 10}
  ],
  "queries": [{"type": "rays", "count": 8, "from": [0, 15, 0], "radius": 10, "drop": 20}],
  "fields": [{"type": "vortex", "radius": 10, "height": 10, "speed": 1, "updraft": 1, "rate": 1}],
  "expect": {"sensors": 1}
})";

/// `small_scene` with the first `from` replaced by `to`.
inline std::string spoilt(const std::string& from, const std::string& to) {
  std::string text = small_scene;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the small scene has no " + from);
  return text.replace(at, from.size(), to);
}

}  // namespace boxstream::scenes_test
