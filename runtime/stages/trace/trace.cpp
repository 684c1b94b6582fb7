// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/trace/trace.hpp"

#include <cstddef>

#include "kernels/shared/solid.h"
#include "kernels/shared/voxel.h"

namespace voxelume {

namespace {

/// The maximum number of shapes that rays test before they walk.
constexpr size_t kMaxShapesAhead = 128;

bool has_cubes(const Pyramid& pyramid) {
    if (!pyramid.attributes.empty()) return pyramid.cubes;
    return pyramid.attribute >> VXL_KIND_SHIFT == VXL_KIND_CUBES;
}

}  // namespace

Features features_of(const Pyramid& pyramid) {
    Features features;
    features.attributes = !pyramid.attributes.empty();
    features.colors = !pyramid.colors.empty();
    features.voxel_opacity = pyramid.transparent;
    features.smooth = !pyramid.fields.empty();
    features.triangles = !pyramid.triangles.empty();
    features.worn_triangles = !pyramid.triangle_textures.empty();
    features.source_meshes = !pyramid.sources.words.empty();
    features.texture_alpha = features.worn_triangles && pyramid.texture_alpha;
    features.texture_maps =
        (features.worn_triangles && pyramid.texture_maps) || pyramid.sources.has_maps;
    features.corner_normals = !pyramid.triangle_normals.empty();
    features.voxel_normals = !pyramid.normals.empty();
    features.resampled_cubes = features.voxel_normals && !pyramid.cube_steps.empty();
    features.solids = !pyramid.solids.empty();
    features.field_lists = pyramid.listed_fields > 0;
    features.field_chains = pyramid.has_chains;
    features.chain_depth = int(pyramid.chain_depth);
    features.instances = !pyramid.instances.empty();
    features.cubes = has_cubes(pyramid);
    features.solids_ahead = features.solids && !features.cubes && !features.smooth &&
                            !features.triangles && !features.instances &&
                            pyramid.solids.size() <= kMaxShapesAhead * VXL_SOLID_WORDS;
    return features;
}

void leave_out_solid_kinds(const Device& device, const Pyramid& pyramid, Features& features) {
    if (device.is_cpu() || pyramid.solids.empty()) return;
    const std::vector<uint32_t> words = pyramid.solids.read();
    constexpr size_t kKind = offsetof(SolidShape, kind) / 4;
    features.solid_kinds = 0;
    for (size_t record = 0; record < words.size(); record += VXL_SOLID_WORDS)
        features.solid_kinds |= 1 << (words[record + kKind] & VXL_SOLID_KIND_MASK);
}

void bind(KernelArguments& to, const Surroundings& surroundings) {
    to.add(surroundings.materials, surroundings.ranks, surroundings.medium_overflows,
           surroundings.absorption, surroundings.density);
}

namespace {

bool shadows_fly(const Features& f) {
    return VXL_REFILLS_SHADOW_LANES(f.paths, f.smooth, f.exact(), f.instances, f.solids_ahead);
}

}  // namespace

TraceStage::TraceStage(const Device& device, const Features& features)
    : packets_(VXL_PACKETS(device.lanes())),
      interleaved_(VXL_INTERLEAVED_PACKETS(device.lanes(), features.smooth, features.exact(),
                                           features.instances)),
      shadow_packets_(shadows_fly(features) ? packets_
                      : features.filter     ? 1
                                            : interleaved_),
      program_(device, "trace.cl", features.defines(device)),
      closest_(program_.kernel("trace_closest")),
      shadows_(program_.kernel("trace_shadows")) {
    if (VXL_REFILLS_LANES(features.paths, features.instances, features.solids_ahead))
        scattered_ = program_.kernel("trace_scattered");
    if (features.observer_in_medium) inside_ = program_.kernel("begin_inside");
}

void TraceStage::closest(const Pyramid& pyramid, RayBatch& batch, uint32_t count, bool scattered) {
    if (pyramid.voxel_count == 0) return batch.hits.fill(VXL_NO_VOXEL);
    if (scattered && scattered_)
        scattered_->launch_packets((count + packets_ - 1) / packets_, pyramid, batch, count);
    else
        closest_.launch_packets((count + interleaved_ - 1) / interleaved_, pyramid, batch, count);
}

void TraceStage::begin_inside(const Pyramid& pyramid, const Surroundings& surroundings,
                              const Buffer<uint32_t>& hollow, uint32_t max_hollow, RayBatch& batch,
                              uint32_t count) {
    inside_.value().launch_packets(count, pyramid, surroundings, hollow, max_hollow, batch, count);
}

void TraceStage::shadows(const Pyramid& pyramid, const Surroundings& surroundings,
                         const ShadowQueue& queue, uint32_t maximum, RayBatch& batch) {
    shadows_.launch_packets((maximum + shadow_packets_ - 1) / shadow_packets_, pyramid,
                            surroundings, queue, batch);
}

}  // namespace voxelume
