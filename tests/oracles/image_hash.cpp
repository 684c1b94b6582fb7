// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/image_hash.hpp"

#include "tests/oracles/fnv.hpp"

namespace voxelume::oracle {

using voxelume::oracle::Fnv;

namespace {

template <class Planes>
void add_planes(const Planes& planes, Fnv& hash) {
    for (const auto& [name, values] : planes) {
        hash.add(name.data(), name.size());
        hash.add(values.data(), values.size() * sizeof values[0]);
    }
}

}  // namespace

uint64_t image_hash(const voxelume::Image& image) {
    Fnv hash;
    hash.add(&image.width, sizeof image.width);
    hash.add(&image.height, sizeof image.height);
    add_planes(image.planes, hash);
    add_planes(image.id_planes, hash);
    return hash.value();
}

}  // namespace voxelume::oracle
