// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/read_file.hpp"
#include "boxstream/mesh/painted_mesh.hpp"
#include "boxstream/mesh/surface.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/print.hpp"
#include "mesh/three_phases.hpp"

namespace boxstream::tool {
namespace {

/// The hot colour map: from black at 0 over red and yellow to white at 1.
picture::Colour hot_colour(double x) {
  const auto channel = [&](double begin, double end) {
    return static_cast<float>(std::clamp((x - begin) / (end - begin), 0.0, 1.0));
  };
  return {channel(0, 0.375), channel(0.375, 0.75), channel(0.75, 1)};
}

struct MeshDistanceOptions {
  std::string a, b;
  std::string picture, picture_back;  // of a, of b; empty: none
};

using imports::TriangleMesh;

/// Of the vertices of one surface from the other.
struct Distances {
  std::vector<double> of_vertex;
  std::size_t farthest = 0;
  double sum = 0, sum_of_squares = 0;

  double largest() const { return of_vertex[farthest]; }
};

Distances distances(const TriangleMesh& from, const TriangleMesh& to) {
  Distances result;
  for (const mesh::Nearest& nearest : mesh::surface_distances(from.vertices, to)) {
    result.of_vertex.push_back(std::sqrt(nearest.squared));
    result.sum += result.of_vertex.back();
    result.sum_of_squares += nearest.squared;
  }
  const auto farthest = std::max_element(result.of_vertex.begin(), result.of_vertex.end());
  result.farthest = static_cast<std::size_t>(farthest - result.of_vertex.begin());
  return result;
}

/// Black where they meet, white where this surface is farthest from the other.
PaintedMesh painted(const TriangleMesh& mesh, const Distances& d, const std::string& other) {
  PaintedMesh result{
      mesh, {}, {"distance from " + other + ", in the files' unit", "0", fmt::format("{:.3g}", d.largest()), {}}};
  for (int i = 0; i <= 8; ++i) result.bar.colours.push_back(hot_colour(i / 8.0));
  for (const double x : d.of_vertex) result.colours.push_back(hot_colour(d.largest() > 0 ? x / d.largest() : 0));
  return result;
}

std::string line(const char* what, const TriangleMesh& mesh, const Distances& d) {
  const auto count = static_cast<double>(d.of_vertex.size());
  const auto& at = mesh.vertices[d.farthest];
  return fmt::format("{}  {:>12}  {:>12.6g}  {:>12.6g}  {:>12.6g}  {} ({:.10g} {:.10g} {:.10g})\n", what,
                     d.of_vertex.size(), d.largest(), d.sum / count, std::sqrt(d.sum_of_squares / count), d.farthest,
                     at[0], at[1], at[2]);
}

int run_mesh_distance(const MeshDistanceOptions& options) {
  files::note_read(options.a);
  files::note_read(options.b);
  std::optional<PaintedMeshFile> picture, picture_back;
  if (!options.picture.empty()) picture.emplace(options.picture);
  if (!options.picture_back.empty()) picture_back.emplace(options.picture_back);
  StatusLine status;
  const TriangleMesh a = surface_in(options.a, status), b = surface_in(options.b, status);
  status.say("from the first to the second");
  const Distances there = distances(a, b);
  status.say("from the second to the first");
  const Distances back = distances(b, a);
  status.say("writing");
  if (picture) picture->write(painted(a, there, "B"));
  if (picture_back) picture_back->write(painted(b, back, "A"));
  status.clear();
  print(fmt::format("from  {:>12}  {:>12}  {:>12}  {:>12}  {}\n", "vertices", "largest", "mean", "rms", "farthest") +
        line("A   ", a, there) + line("B   ", b, back) +
        fmt::format("both  {:>12}  {:>12.6g}  {:>12.6g}  {:>12.6g}\n", there.of_vertex.size() + back.of_vertex.size(),
                    std::max(there.largest(), back.largest()),
                    (there.sum + back.sum) / static_cast<double>(there.of_vertex.size() + back.of_vertex.size()),
                    std::sqrt((there.sum_of_squares + back.sum_of_squares) /
                              static_cast<double>(there.of_vertex.size() + back.of_vertex.size()))));
  return 0;
}

Action set_up_mesh_distance(CommandLine& command) {
  const auto options = std::make_shared<MeshDistanceOptions>();
  add_input(command, "A", options->a, "Mesh")->required();
  add_input(command, "B", options->b, "Mesh")->required();
  command.add_option("--picture", options->picture, "Write A, coloured by distance from B: FILE.ply, .glb or .png")
      ->type_name("FILE");
  command.add_option("--picture-back", options->picture_back, "Write B, coloured by distance from A")
      ->type_name("FILE");
  return [options] { return run_mesh_distance(*options); };
}

}  // namespace

extern const Command mesh_distance_command{"distance", "Print the distance of two surfaces", "", set_up_mesh_distance};

}  // namespace boxstream::tool
