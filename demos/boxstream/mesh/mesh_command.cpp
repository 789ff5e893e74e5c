// SPDX-License-Identifier: MIT
#include "boxstream/shared/command.hpp"

namespace boxstream::tool {

extern const Command mesh_check_command, mesh_distance_command, mesh_make_command;

extern const Command mesh_command{"mesh",
                                  "Surfaces: self-intersections, and the distance of two",
                                  R"(Examples:
  boxstream mesh make klein 200 --out klein.ply
  boxstream mesh check klein.ply --picture klein.png
  boxstream mesh distance original.stl simplified.stl --picture error.ply

Files are read as .obj, .stl, .ply, .off, .dae, .gltf and .glb; vertices at the same place are one. They are written as .ply and
.glb, with a colour for each vertex, or .png.

check finds all pairs of triangles that intersect, exactly, touching and lying in one plane included. Triangles that
share a vertex or an edge count if they have more in common than that. Triangles without area are counted, and in no
pair. The picture has triangles that intersect in red.

distance is that of the vertices of each surface from the other surface. Between vertices it can be larger. Pictures go
from black, where the surfaces meet, over red and yellow to white, where they are farthest apart.

Exit code: 0; 1 if check finds a pair, or a run fails; 2 for bad input, with nothing written.)",
                                  nullptr,
                                  {&mesh_check_command, &mesh_distance_command, &mesh_make_command}};

}  // namespace boxstream::tool
