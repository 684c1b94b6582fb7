// Analytic solids and their combinations, from a scene's "shape" and "parts".
#include <fmt/format.h>

#include <algorithm>

#include "runtime/scene/scene_affine.hpp"
#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {
namespace {

/// Both follow the order of the shapes in the key tables.
constexpr SolidKind kKinds[] = {
    SolidKind::sphere,   SolidKind::ellipsoid,       SolidKind::box,           SolidKind::cylinder,
    SolidKind::cone,     SolidKind::torus,           SolidKind::capsule,       SolidKind::slab,
    SolidKind::union_of, SolidKind::intersection_of, SolidKind::difference_of,
};

void read_parameters(const SceneFields& fields, Solid& solid) {
    const auto length = [&](std::string_view key) { return fields.get(key).number(kLength); };
    switch (solid.kind) {
        case SolidKind::sphere:
            solid.radius = length("radius");
            break;
        case SolidKind::ellipsoid:
            solid.radii = fields.get("radii").vector(kLength);
            break;
        case SolidKind::box:
            solid.size = fields.get("size").vector(kLength);
            break;
        case SolidKind::cone:
            solid.top_radius = fields.number("top_radius", kNotNegative, 0);
            [[fallthrough]];
        case SolidKind::cylinder:
        case SolidKind::capsule:
            solid.radius = length("radius");
            solid.height = length("height");
            break;
        case SolidKind::torus:
            solid.radius = length("radius");
            solid.tube = length("tube");
            if (solid.tube > solid.radius) {
                fields.get("tube").fail("must not be larger than the torus's radius");
            }
            break;
        case SolidKind::slab:
            solid.thickness = length("thickness");
            break;
        case SolidKind::union_of:
        case SolidKind::intersection_of:
        case SolidKind::difference_of:
            break;
    }
}

/// Reads one tree and counts its shapes. The recursion ends at kMaxSolidDepth.
class SolidReader {
  public:
    Solid read(const SceneValue& value, std::string_view prefix, int depth) {
        const size_t kind = kind_of(value, "shape", "part");
        const std::string table = fmt::format("{}:{}", prefix, scene_kinds("part")[kind]);
        const SceneFields fields(value, table);
        if (depth > kMaxSolidDepth) {
            value.fail(fmt::format("solids are nested more than {} levels deep", kMaxSolidDepth));
        }
        Solid solid;
        solid.kind = kKinds[kind];
        read_parameters(fields, solid);
        if (prefix == "part") solid.parent_from_solid = read_placement(fields);
        if (is_combination(solid.kind)) {
            read_parts(fields.get("parts"), solid, depth);
        } else if (++shapes_ > kMaxSolidShapes) {
            value.fail(fmt::format("a model holds at most {} shapes", kMaxSolidShapes));
        }
        return solid;
    }

    /// Parts of something that counts as one shape and isn't a solid.
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

bool is_infinite(const Solid& solid) {
    switch (solid.kind) {
        case SolidKind::slab:
            return true;
        case SolidKind::union_of:
            return std::any_of(solid.parts.begin(), solid.parts.end(), is_infinite);
        case SolidKind::intersection_of:
            return std::all_of(solid.parts.begin(), solid.parts.end(), is_infinite);
        case SolidKind::difference_of:
            return is_infinite(solid.parts.front());
        default:
            return false;
    }
}

Solid read_solid(const SceneValue& value) {
    return SolidReader().read(value, "model", 1);
}

std::vector<Solid> read_cuts(const SceneValue& value) {
    return SolidReader().read_list(value);
}

Factors read_factors(const SceneFields& fields) {
    const auto scale = fields.find("scale");
    return {fields.vector("position", kCoordinate, {}), fields.vector("turn", kDegrees, {}),
            scale ? scale->number_or_vector({-1e6, 1e6}) : glm::dvec3(1)};
}

glm::dmat4 read_placement(const SceneFields& fields) {
    for (const std::string_view factor : {"position", "turn", "scale"})
        fields.refuse_both(factor, "matrix");

    glm::dmat4 map(1);
    if (const auto matrix = fields.find("matrix")) {
        const auto rows = matrix->items();
        if (rows.size() != 3)
            matrix->fail(fmt::format("needs 3 rows of 4 numbers, not {}", rows.size()));
        for (int row = 0; row < 3; ++row) {
            const auto numbers = rows[row].items();
            if (numbers.size() != 4) {
                rows[row].fail(fmt::format("needs 4 numbers, not {}", numbers.size()));
            }
            for (int column = 0; column < 4; ++column) {
                map[column][row] = numbers[column].number(kCoordinate);
            }
        }
    } else {
        map = affine_from_factors(read_factors(fields));
    }

    const Stretch stretch = stretch_of(glm::dmat3(map));
    const auto culprit = [&] {
        const auto found = fields.find("matrix");
        return found ? *found : fields.get("scale");
    };
    if (stretch.min < kMinStretch) {
        culprit().fail("is singular: it flattens the object to nothing in one direction");
    }
    if (stretch.max > stretch.min * kMaxCondition) {
        culprit().fail(
            fmt::format("stretches {:.3g} times as much in one direction as in another, which "
                        "is close to singular; at most {} times is allowed",
                        stretch.max / stretch.min, kMaxCondition));
    }
    return map;
}

}  // namespace voxelume
