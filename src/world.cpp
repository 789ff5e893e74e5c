// SPDX-License-Identifier: MIT
#include <boxstream/world.hpp>
