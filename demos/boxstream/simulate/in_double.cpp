// SPDX-License-Identifier: MIT
#include "boxstream/simulate/in_double.hpp"

#include <unistd.h>

#include <cstdio>

#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/run.hpp"
#include "boxstream/shared/scene_files.hpp"

namespace boxstream::tool {

void run_in_double() {
  std::fflush(nullptr);
  const std::filesystem::path here = executable_directory();
  for (const std::filesystem::path& place : {here, here / ".." / "libexec" / "boxstream"})
    execv((place / "boxstream-double").c_str(), given_arguments());
  throw BadInput(
      "--precision double: boxstream-double, the part of this tool that has worlds of double precision, is not "
      "installed; it is built where Bullet is there in both precisions");
}

}  // namespace boxstream::tool
