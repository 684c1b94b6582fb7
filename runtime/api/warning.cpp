// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/warning.hpp"

#include <array>

namespace voxelume {
namespace {

constexpr std::array kWarningNames = {
    "outside_world",      "no_voxels",        "thinner_than_voxel", "light_inside_object",
    "observer_in_object", "nothing_in_view",  "no_light",           "finer_than_world",
    "coarser_than_world", "open_mesh",        "inside_out_mesh",    "unlikely_unit",
    "ignored_materials",  "world_not_cached", "cache_not_writable", "ignored_scattering",
    "rounded_edges",      "one_moment",       "no_effect"};
static_assert(kWarningNames.size() == size_t(WarningKind::no_effect) + 1);
static_assert(int(v1::WarningKind::no_effect) == int(WarningKind::no_effect));

}  // namespace

std::vector<v1::Warning> api::warnings_for_callers(std::span<const Warning> warnings) {
    std::vector<v1::Warning> result;
    for (const Warning& warning : warnings)
        result.push_back(
            {static_cast<v1::WarningKind>(warning.kind), warning.where.text(), warning.text});
    return result;
}

const char* v1::name_of(WarningKind kind) {
    return kWarningNames.at(size_t(kind));
}

}  // namespace voxelume
