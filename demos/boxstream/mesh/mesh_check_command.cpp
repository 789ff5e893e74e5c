// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/read_file.hpp"
#include "boxstream/mesh/painted_mesh.hpp"
#include "boxstream/mesh/surface.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/print.hpp"
#include "mesh/self_intersection.hpp"

namespace boxstream::tool {
namespace {

struct MeshCheckOptions {
  std::string file;
  bool list = false;
  std::string picture;  // empty: none
};

using mesh::SelfIntersections;

constexpr picture::Colour quiet{0.72F, 0.74F, 0.77F}, intersecting{0.83F, 0.07F, 0.05F};
constexpr std::size_t most_pairs_shown = 10;

/// Of each triangle, whether it is in a pair.
std::vector<bool> marked(std::size_t triangles, const SelfIntersections& found) {
  std::vector<bool> marks(triangles);
  for (const Pair pair : found.pairs) marks[pair.a] = marks[pair.b] = true;
  return marks;
}

/// Colours belong to vertices, so triangles that are marked get vertices of their own.
PaintedMesh painted(const imports::TriangleMesh& mesh, const std::vector<bool>& marks) {
  PaintedMesh result{mesh, std::vector<picture::Colour>(mesh.vertices.size(), quiet), {}};
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (!marks[i]) continue;
    for (std::uint32_t& corner : result.mesh.triangles[i]) {
      result.mesh.vertices.push_back(mesh.vertices[corner]);
      result.colours.push_back(intersecting);
      corner = static_cast<std::uint32_t>(result.mesh.vertices.size() - 1);
    }
  }
  return result;
}

/// The pairs by the file's faces, of which triangles are parts; each once. Parts of one face are none.
std::vector<Pair> pairs_of_faces(const imports::TriangleMesh& mesh, const SelfIntersections& found) {
  std::vector<Pair> pairs;
  for (const Pair pair : found.pairs) {
    const auto [low, high] = std::minmax(mesh.faces[pair.a], mesh.faces[pair.b]);
    if (low != high) pairs.push_back({low, high});
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

std::string report(const imports::TriangleMesh& mesh, const SelfIntersections& found, const std::vector<Pair>& pairs,
                   std::ptrdiff_t triangles, bool list) {
  std::string text;
  const auto line = [&](const char* what, std::uint64_t count) {
    text += fmt::format("{:<24}{:>14}\n", what, grouped(count));
  };
  line("vertices", mesh.vertices.size());
  line("faces", std::size_t{mesh.faces.back()} + 1);
  line("triangles", mesh.triangles.size());
  line("without area", found.without_area.size());
  line("candidate pairs", found.candidates);
  line("intersecting pairs", pairs.size());
  line("triangles in them", static_cast<std::uint64_t>(triangles));
  const std::size_t shown = list ? pairs.size() : std::min(pairs.size(), most_pairs_shown);
  for (std::size_t i = 0; i < shown; ++i) text += fmt::format("{} {}\n", pairs[i].a, pairs[i].b);
  if (shown < pairs.size()) text += fmt::format("and {} more: --list\n", grouped(pairs.size() - shown));
  return text;
}

int run_mesh_check(const MeshCheckOptions& options) {
  files::note_read(options.file);  // before anything is written over it
  std::optional<PaintedMeshFile> picture;
  if (!options.picture.empty()) picture.emplace(options.picture);
  StatusLine status;
  const imports::TriangleMesh mesh = surface_in(options.file, status);
  status.say(fmt::format("searching {} triangles", grouped(mesh.triangles.size())));
  const SelfIntersections found = mesh::self_intersections(mesh);
  const std::vector<bool> marks = marked(mesh.triangles.size(), found);
  if (picture) {
    status.say("writing " + options.picture);
    picture->write(painted(mesh, marks));
  }
  status.clear();
  const std::vector<Pair> pairs = pairs_of_faces(mesh, found);
  print(report(mesh, found, pairs, std::count(marks.begin(), marks.end(), true), options.list));
  return pairs.empty() ? 0 : 1;
}

Action set_up_mesh_check(CommandLine& command) {
  const auto options = std::make_shared<MeshCheckOptions>();
  add_input(command, "FILE", options->file, "Mesh")->required();
  command.add_flag(
      "--list", options->list,
      "Print all pairs, by numbers of the file's faces from 0 on (.dae, .gltf, .glb: of triangles, in order of "
      "material)");
  command.add_option("--picture", options->picture, "Write it with them in red: FILE.ply, .glb or .png")
      ->type_name("FILE");
  return [options] { return run_mesh_check(*options); };
}

}  // namespace

extern const Command mesh_check_command{"check", "Find the triangles of a surface that intersect", "",
                                        set_up_mesh_check};

}  // namespace boxstream::tool
