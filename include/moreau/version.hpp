// SPDX-License-Identifier: MIT
// moreau: contact dynamics of rigid grains. The one place that holds the version; CMake reads it
// here.
#pragma once

#define MOREAU_VERSION_MAJOR 0
#define MOREAU_VERSION_MINOR 2
#define MOREAU_VERSION_PATCH 0
#define MOREAU_VERSION_STRING "0.2.0"
