// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/resolve/matte.hpp"

#include "kernels/shared/matte.h"
#include "kernels/shared/voxel.h"
#include "runtime/image/cryptomatte.hpp"

namespace voxelume {
namespace {

constexpr const char* kFewerChannels = "render a smaller image, or without Cryptomatte";

size_t matte_count(const ImageChannels& channels) {
    return size_t(channels.object_matte) + size_t(channels.material_matte);
}

}  // namespace

std::vector<MatteArrays> allocate_mattes(const Device& device, const glm::ivec2& size,
                                         const ImageChannels& channels) {
    const size_t values = size_t(size.x) * size_t(size.y) * VXL_MATTE_RANKS;
    std::vector<MatteArrays> arrays;
    for (size_t i = 0; i < matte_count(channels); ++i) {
        arrays.push_back({{device, "matte numbers", values, kFewerChannels},
                          {device, "matte shares", values, kFewerChannels}});
        arrays.back().numbers.fill(0);  // other devices may render some of the tiles
    }
    return arrays;
}

std::vector<MatteStage::Matte> MatteStage::mattes_of(const Scene& scene) {
    std::vector<Matte> mattes;
    if (scene.render.channels.object_matte) {
        Matte& matte = mattes.emplace_back(Matte{"CryptoObject", 0, VXL_OBJECT_MASK, {}});
        for (const Object& object : scene.objects) matte.names.push_back(object.name);
    }
    if (scene.render.channels.material_matte) {
        Matte& matte =
            mattes.emplace_back(Matte{"CryptoMaterial", VXL_MATERIAL_SHIFT, VXL_MATERIAL_MASK, {}});
        for (const Material& material : scene.materials) matte.names.push_back(material.name);
    }
    return mattes;
}

MatteStage::MatteStage(const Device& device, const Features& features, const Camera& camera,
                       const Scene& scene)
    : camera_(camera),
      mattes_(mattes_of(scene)),
      arrays_(allocate_mattes(device, {camera.width, camera.height}, scene.render.channels)) {
    if (mattes_.empty()) return;
    program_.emplace(device, "matte.cl", features.defines(device));
    rank_.emplace(program_->kernel("rank_matte"));
}

void MatteStage::pixels(const RayBatch& batch, uint32_t first_tile, uint32_t tiles) {
    for (size_t i = 0; i < mattes_.size(); ++i)
        rank_->launch(WorkItem::light, size_t(tiles) * 16, camera_, batch, first_tile, tiles,
                      mattes_[i].shift, mattes_[i].mask, arrays_[i].numbers, arrays_[i].shares);
}

void MatteStage::add_to(Image& image) const {
    for (size_t i = 0; i < mattes_.size(); ++i)
        add_cryptomatte(mattes_[i].layer, mattes_[i].names,
                        {arrays_[i].numbers.read(), arrays_[i].shares.read(), VXL_MATTE_RANKS},
                        image);
}

}  // namespace voxelume
