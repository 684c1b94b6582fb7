// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/resolve/matte.hpp"

#include <utility>

#include "kernels/shared/matte.h"
#include "kernels/shared/voxel.h"
#include "runtime/image/cryptomatte.hpp"
#include "runtime/stages/resolve/resolve.hpp"

namespace voxelume {
namespace {

constexpr const char* kFewerChannels = "render a smaller image, or without Cryptomatte";

size_t matte_count(const ImageChannels& channels) {
    return size_t(channels.object_matte) + size_t(channels.material_matte);
}

}  // namespace

std::vector<MatteArrays> allocate_mattes(const Device& device, const glm::ivec2& size,
                                         const ImageChannels& channels, bool adds_samples) {
    const size_t ranks = adds_samples ? VXL_MATTE_HELD : VXL_MATTE_RANKS;
    const size_t values = size_t(size.x) * size_t(size.y) * ranks;
    std::vector<MatteArrays> arrays;
    for (size_t i = 0; i < matte_count(channels); ++i) {
        arrays.push_back({{device, "matte numbers", values, kFewerChannels},
                          {device, "matte shares", values, kFewerChannels}});
        arrays.back().numbers.fill(0);  // other devices may render some of the tiles
    }
    return arrays;
}

std::vector<MatteStage::Field> MatteStage::fields_of(const ImageChannels& channels) {
    std::vector<Field> fields;
    if (channels.object_matte) fields.push_back({0, VXL_OBJECT_MASK});
    if (channels.material_matte) fields.push_back({VXL_MATERIAL_SHIFT, VXL_MATERIAL_MASK});
    return fields;
}

MatteStage::MatteStage(const Device& device, const Features& features, const Camera& camera,
                       const Scene& scene, std::vector<MatteArrays> arrays, bool adds_samples)
    : camera_(camera), fields_(fields_of(scene.render.channels)), arrays_(std::move(arrays)) {
    if (fields_.empty()) return;
    program_.emplace(device, "matte.cl",
                     resolve_defines(device, features, scene.render.channels, adds_samples));
    rank_.emplace(program_->kernel("rank_matte"));
}

void MatteStage::pixels(const RayBatch& batch, uint32_t first_tile, uint32_t tiles) {
    for (size_t i = 0; i < fields_.size(); ++i)
        rank_->launch(WorkItem::light, size_t(tiles) * 16, camera_, batch, first_tile, tiles,
                      fields_[i].shift, fields_[i].mask, arrays_[i].numbers, arrays_[i].shares);
}

void add_mattes(const std::vector<MatteArrays>& arrays, const Scene& scene, Image& image) {
    auto matte = arrays.begin();
    const auto add = [&](const char* layer, const auto& named) {
        std::vector<std::string> names;
        names.reserve(named.size());
        for (const auto& part : named) names.push_back(part.name);
        const size_t values = size_t(image.width) * size_t(image.height) * VXL_MATTE_RANKS;
        add_cryptomatte(
            layer, names,
            {matte->numbers.read(0, values), matte->shares.read(0, values), VXL_MATTE_RANKS},
            image);
        ++matte;
    };
    if (scene.render.channels.object_matte) add("CryptoObject", scene.objects);
    if (scene.render.channels.material_matte) add("CryptoMaterial", scene.materials);
}

}  // namespace voxelume
