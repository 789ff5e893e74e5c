// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace boxstream::tests {

/// Where a file or a folder of the project's sources is: "tests/lab/poses/poses.json".
std::string source_path(std::string_view path);

}  // namespace boxstream::tests
