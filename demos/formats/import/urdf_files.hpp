// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxstream::imports {

/// Where the mesh is that a URDF calls `name`: a path, "file://PATH" or "package://NAME/REST".
///
/// ROS finds packages by itself. Here NAME is looked for as a folder in each of `packages`, then above the URDF and
/// beside each folder above it; then REST alone in the same places, for packages whose folder is called otherwise.
///
/// It lies in the folder `within` or below it, wherever names and symbolic links lead; empty: anywhere.
///
/// Throws std::runtime_error that says where it was searched.
std::string find_mesh(const std::string& urdf, const std::string& name, const std::vector<std::string>& packages,
                      const std::string& within);

/// The text with <capsule radius="R" length="L"/>, which older readers refuse, as <mesh filename="capsule:R L"/>.
std::string with_capsules_as_meshes(const std::string& text);

/// Radius and length, between the centres of the two ends.
struct CapsuleSize {
  double radius;
  double length;
};

/// Does a mesh stand for a capsule?
bool is_capsule(const std::string& mesh_name);
/// Throws std::runtime_error for sizes that are no numbers.
CapsuleSize capsule_size(const std::string& mesh_name);

}  // namespace boxstream::imports
