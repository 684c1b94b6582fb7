// SPDX-License-Identifier: Apache-2.0
// Summaries of meshes <-> the bytes of cache entries.
#pragma once

#include <optional>
#include <string>

#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/geometry/shape/mesh_shape.hpp"

namespace voxelume {

std::string bytes_of(const MeshSummary& summary);
std::string bytes_of(const MeshShape& shape);
/// The summary or the shape in these bytes; empty where they hold none.
std::optional<MeshSummary> summary_of_bytes(const std::string& bytes);
std::optional<MeshShape> shape_of_bytes(const std::string& bytes);

}  // namespace voxelume
