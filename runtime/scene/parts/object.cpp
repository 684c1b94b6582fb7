// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/parts/object.hpp"

#include <array>

namespace voxelume {

std::optional<Model> thin_part_of(const Model& model) {
    if (model.thin_edge == 0 || model.is_thin_part || !stores_distances(model.surface)) return {};
    Model part = model;
    part.surface = Surface::exact;
    part.is_thin_part = true;
    return part;
}

std::span<const ValueRow<Model>> model_rows() {
    static constexpr std::array<ValueRow<Model>, 2> rows = {
        {{"mesh", &Model::mesh}, {"voxels", &Model::voxels}}};
    return rows;
}

std::span<const ValueRow<Morph>> morph_rows() {
    static constexpr std::array<ValueRow<Morph>, 5> rows = {
        {{"weights", &Morph::weights, {-1000, 1000}},
         {"amount", &Morph::amount, kRatio},
         {"center", &Morph::center, kCoordinate},
         {"radius", &Morph::radius, kLength},
         {"time", &Morph::time, {0, 1e6}}}};
    return rows;
}

std::span<const ValueRow<Object>> object_rows() {
    static constexpr std::array<ValueRow<Object>, 3> rows = {{{"visible", &Object::visible},
                                                              {"model", &Object::model},
                                                              {"material", &Object::material}}};
    return rows;
}

}  // namespace voxelume
