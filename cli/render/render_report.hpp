// SPDX-License-Identifier: Apache-2.0
// The summary of a render, for people: the summary line and -v.
#pragma once

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

void print_summary(const Statistics& statistics);
void print_details(const Statistics& statistics);

}  // namespace voxelume::cli
