// SPDX-License-Identifier: MIT
// The readers of mesh files: any bytes give triangles between vertices that are there, or a complaint in one line.
//
// Input: byte 0, modulo 4: .obj, .ply, .stl, .off; then the file.
#include <stdexcept>
#include <string_view>

#include "finding.hpp"
#include "formats/import/mesh_files/mesh_files.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace boxstream;
  using fuzz::promise, fuzz::promise_one_line;
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  constexpr decltype(&imports::read_obj) readers[] = {imports::read_obj, imports::read_ply, imports::read_stl,
                                                      imports::read_off};
  try {
    const imports::RawMesh mesh = readers[data[0] % 4](bytes);
    promise(mesh.faces.size() == mesh.triangles.size(), "a face for each triangle");
    for (std::size_t i = 1; i < mesh.faces.size(); ++i) promise(mesh.faces[i - 1] <= mesh.faces[i], "faces ascend");
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t corner : triangle) promise(corner < mesh.vertices.size(), "corners are vertices");
  } catch (const std::runtime_error& error) {
    promise_one_line(error.what());
  }
  return 0;
}
