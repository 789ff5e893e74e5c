// SPDX-License-Identifier: MIT
#pragma once

/// Version of the headers, as numbers for the preprocessor; the package version is the same.
#define BOXSTREAM_VERSION_MAJOR 0
#define BOXSTREAM_VERSION_MINOR 2
#define BOXSTREAM_VERSION_PATCH 0
