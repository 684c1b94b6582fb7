// SPDX-License-Identifier: Apache-2.0
// Analytic solids and their combinations, from a scene's "shape" and "parts".
#include <fmt/format.h>

#include <algorithm>

#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/scene/parts/solid.hpp"
#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {
namespace {

/// Reads one tree and counts its shapes. The recursion ends at kMaxSolidDepth.
class SolidReader {
  public:
    Solid read(const SceneValue& value, std::string_view prefix, int depth) {
        const SolidType& shape = solid_types()[kind_of(value, "shape", "part")];
        const SceneFields fields(value, fmt::format("{}:{}", prefix, shape.name));
        if (depth > kMaxSolidDepth) {
            value.fail(fmt::format("solids are nested more than {} levels deep", kMaxSolidDepth));
        }
        Solid solid;
        solid.kind = shape.kind;
        fields.read_kind(shape.keys, solid_rows(), solid);
        check_solid(solid, fields.refusal());
        if (prefix == "part") solid.parent_from_solid = read_placement(fields);
        if (is_combination(solid.kind)) {
            read_parts(fields.get("parts"), solid, depth);
        } else if (++shapes_ > kMaxSolidShapes) {
            value.fail(fmt::format("a model holds at most {} shapes", kMaxSolidShapes));
        }
        return solid;
    }

    /// Reads the parts of something that counts as one shape and isn't a solid.
    std::vector<Solid> read_list(const SceneValue& value) {
        Solid of;
        ++shapes_;
        read_parts(value, of, 1);
        return std::move(of.parts);
    }

  private:
    void read_parts(const SceneValue& value, Solid& solid, int depth) {
        const auto parts = value.items();
        if (parts.empty()) value.fail("needs at least one part");
        for (const SceneValue& part : parts) solid.parts.push_back(read(part, "part", depth + 1));
    }

    int shapes_ = 0;
};

}  // namespace

Solid read_solid(const SceneValue& value) {
    return SolidReader().read(value, "model", 1);
}

std::vector<Solid> read_cuts(const SceneValue& value) {
    return SolidReader().read_list(value);
}

}  // namespace voxelume
