// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/mesh/ply/mesh_ply_layout.hpp"

#include <algorithm>

namespace voxelume {
namespace {

struct RoleName {
    std::string_view name;
    PlyRole role;
};

/// Programs that write textured meshes don't agree on the names of texture coordinates.
constexpr RoleName kRoleNames[] = {
    {"x", kPlyX},       {"y", kPlyY},         {"z", kPlyZ},         {"nx", kPlyNx},
    {"ny", kPlyNy},     {"nz", kPlyNz},       {"red", kPlyRed},     {"green", kPlyGreen},
    {"blue", kPlyBlue}, {"alpha", kPlyAlpha}, {"u", kPlyU},         {"v", kPlyV},
    {"s", kPlyU},       {"t", kPlyV},         {"texture_u", kPlyU}, {"texture_v", kPlyV}};

PlyRole role_of(const PlyProperty& property) {
    std::string_view name = property.name;
    if (name.starts_with("diffuse_")) {
        name.remove_prefix(8);
    }
    const auto* const found = std::ranges::find(kRoleNames, name, &RoleName::name);
    return property.is_list || found == std::end(kRoleNames) ? kPlySkipped : found->role;
}

/// The largest value of a colour's type, which stands for full intensity; 0 if colours can't have
/// the type.
double color_scale(PlyType type) {
    switch (type) {
        case PlyType::uint8:
            return 255.0;
        case PlyType::uint16:
            return 65535.0;
        case PlyType::float32:
        case PlyType::float64:
            return 1.0;
        default:
            return 0.0;
    }
}

void note_what_is_whole(const std::array<int, kPlyRoles>& found, PlyLayout& layout) {
    const auto has = [&](std::initializer_list<PlyRole> roles) {
        return std::ranges::all_of(roles, [&](PlyRole role) { return found[role] != 0; });
    };
    layout.has_normal = has({kPlyNx, kPlyNy, kPlyNz});
    layout.has_color = has({kPlyRed, kPlyGreen, kPlyBlue});
    layout.has_alpha = has({kPlyAlpha});
    layout.has_uv = has({kPlyU, kPlyV});
}

}  // namespace

PlyLayout ply_vertex_layout(const MeshSource& source, const PlyElement& element) {
    PlyLayout layout;
    std::array<int, kPlyRoles> found{};
    for (const PlyProperty& property : element.properties) {
        PlyRole role = role_of(property);
        if (role == kPlyAlpha && color_scale(property.type) == 0.0) role = kPlySkipped;
        layout.roles.push_back(role);
        if (role == kPlySkipped) {
            continue;
        }
        layout.scale[role] = is_ply_color(role) ? color_scale(property.type) : 1.0;
        if (++found[role] > 1) {
            if (role < kPlyAlpha)
                source.fail(fmt::format("the vertices have two properties '{}'", property.name));
            layout.roles.back() = kPlySkipped;
        }
        if (layout.scale[role] == 0.0) {
            source.fail(fmt::format("the vertices' '{}' must be uchar, ushort, float or double",
                                    property.name));
        }
    }
    for (const PlyRole role : {kPlyX, kPlyY, kPlyZ}) {
        if (found[role] == 0) {
            source.fail(fmt::format("the vertices have no property '{}'", kRoleNames[role].name));
        }
    }
    note_what_is_whole(found, layout);
    return layout;
}

PlyLayout ply_face_layout(const PlyElement& element) {
    PlyLayout layout;
    std::array<int, kPlyRoles> found{};
    for (const PlyProperty& property : element.properties) {
        PlyRole role = role_of(property);
        if (!is_ply_color(role) || color_scale(property.type) == 0.0 || found[role] != 0) {
            role = kPlySkipped;
        } else {
            layout.scale[role] = color_scale(property.type);
            ++found[role];
        }
        layout.roles.push_back(role);
    }
    note_what_is_whole(found, layout);
    return layout;
}

glm::dvec3 ply_color(const PlyRow& row, const PlyLayout& layout) {
    glm::dvec3 color;
    for (size_t i = 0; i < 3; ++i) {
        const double value = row[kPlyRed + i], scale = layout.scale[kPlyRed + i];
        if (!(value >= 0.0 && value <= scale)) return {-1, value, scale};
        color[static_cast<int>(i)] = value / scale;
    }
    return color;
}

}  // namespace voxelume
