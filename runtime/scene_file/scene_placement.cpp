// SPDX-License-Identifier: Apache-2.0
// The placements of objects, parts of solids and densities.
#include <fmt/format.h>

#include <array>

#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {

Factors read_factors(const SceneFields& fields) {
    Factors factors;
    fields.read_rows(factor_rows(), factors);
    return factors;
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

    check_map(map, fields.has("matrix") ? "matrix" : "scale", fields.refusal());
    return map;
}

std::vector<glm::dmat4> read_links(const SceneFields& object) {
    constexpr size_t kMaxParents = 256;
    std::vector<glm::dmat4> links;
    if (const auto parents = object.find("parents")) {
        if (parents->items().size() > kMaxParents)
            parents->fail(fmt::format("has {} parents; at most {} are allowed",
                                      parents->items().size(), kMaxParents));
        for (const SceneValue& parent : parents->items())
            links.push_back(read_placement(SceneFields(parent, "parent")));
    }
    links.push_back(read_placement(object));
    return links;
}

glm::dmat4 read_object_place(const SceneFields& object) {
    const std::vector<glm::dmat4> links = read_links(object);
    const glm::dmat4 map = product_of(links);
    if (links.size() > 1) check_map(map, "parents", object.refusal());
    return map;
}

}  // namespace voxelume
