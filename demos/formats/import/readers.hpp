// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/import/fragment.hpp"
#include "formats/import/import_file.hpp"

/// The reader of each kind of file. The first two run in a child process (guarded.hpp) and throw any std::exception
/// with the reason; a kind whose library was not there at build time has one that says so.
namespace boxstream::imports {

void read_urdf(const std::string& path, const ImportOptions& options, Fragment& out);
void read_bullet(const std::string& path, Fragment& out);

/// The only one that is called outside: it guards the reading itself, and what it throws names the file.
void add_mesh_body(const std::string& path, const ImportOptions& options, Fragment& out);

}  // namespace boxstream::imports
