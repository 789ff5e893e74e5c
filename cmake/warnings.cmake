# SPDX-License-Identifier: MIT
# One target for the warnings of our own code; errors in CI only (-DBOXSTREAM_WERROR=ON).
option(BOXSTREAM_WERROR "Treat warnings as errors" OFF)
add_library(boxstream_warnings INTERFACE)
target_compile_options(boxstream_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast -Wundef
  $<$<BOOL:${BOXSTREAM_WERROR}>:-Werror>)
