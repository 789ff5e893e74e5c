// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace boxstream::tool {

struct QueryOptions {
  std::string scene;
  std::string manager;  // empty: boxstream
  std::optional<std::string> compare;
  std::optional<std::uint64_t> steps;  // none: as the scene says
  double scale = 1;
  std::string json;     // empty: none; "-": standard output, in place of the table
  std::string picture;  // empty: none
};

/// Those of query::manager_names(); none if this program was built without FCL.
std::vector<std::string> manager_names();

/// The command query. Throws BadInput if this program was built without FCL.
int run_queries(const QueryOptions& options);

}  // namespace boxstream::tool
