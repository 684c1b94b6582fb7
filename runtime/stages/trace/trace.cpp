#include "runtime/stages/trace/trace.hpp"

#include <bit>
#include <cmath>

#include "kernels/shared/voxel.h"

namespace voxelume {

PyramidShape shape_of(const Pyramid& pyramid) {
    const GridFrame& frame = pyramid.frame;
    const int longest = std::max({frame.size.x, frame.size.y, frame.size.z});
    // Coordinates 0 .. longest need integer_bits; the rest of a float's 24 bits is fraction, so
    // that every coordinate is an exact float and its fixed-point integer an exact float too.
    const int integer_bits = std::bit_width(static_cast<unsigned>(longest));
    PyramidShape shape{};
    const glm::dvec3& edge = frame.voxel_edge;
    shape.edge = {float(edge.x), float(edge.y), float(edge.z), 0};
    shape.inverse_edge = {float(1 / edge.x), float(1 / edge.y), float(1 / edge.z), 0};
    shape.size_x = frame.size.x;
    shape.size_y = frame.size.y;
    shape.size_z = frame.size.z;
    shape.sectors_x = frame.sectors().x;
    shape.sectors_y = frame.sectors().y;
    // t = (K - o) (1/d) has two roundings of half a unit, o + d t one more: together less than
    // 2.5 * 2^-24 of the longest side; 4 units leave room for the comparison's own rounding.
    shape.plane_bound = std::ldexp(1.0f, integer_bits + 2 - 24);
    shape.fixed_point = std::ldexp(1.0f, 24 - integer_bits);
    shape.origin_offset = pyramid.instances.origin_offset;
    return shape;
}

Features features_of(const Pyramid& pyramid) {
    Features features;
    features.attributes = !pyramid.attributes.empty();
    features.colors = !pyramid.colors.empty();
    features.voxel_opacity = pyramid.transparent;
    features.smooth = !pyramid.fields.empty();
    features.triangles = !pyramid.triangles.empty();
    features.solids = !pyramid.solids.empty();
    const uint32_t kind = pyramid.attribute >> VXL_KIND_SHIFT;
    features.instances = !pyramid.instances.empty();
    features.cubes = features.attributes || kind == VXL_KIND_CUBES;
    return features;
}

namespace {

bool shadows_fly(const Features& f) {
    return VXL_REFILLS_SHADOW_LANES(f.paths, f.smooth, f.exact(), f.instances);
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
    if (VXL_REFILLS_LANES(features.paths, features.instances))
        scattered_ = program_.kernel("trace_scattered");
    if (features.observer_in_medium) inside_ = program_.kernel("begin_inside");
}

void TraceStage::closest(const Pyramid& pyramid, RayBatch& batch, uint32_t count, bool scattered) {
    if (pyramid.voxel_count == 0) return batch.hits.fill(VXL_NO_VOXEL);
    const auto launch = [&](Kernel& kernel, size_t rays, const auto&... beams) {
        kernel.launch_packets(
            rays, shape_of(pyramid), pyramid.sectors, pyramid.bricks, pyramid.leaves,
            pyramid.leaf_voxels, pyramid.attributes, pyramid.fields, pyramid.primitive_first,
            pyramid.primitives, pyramid.triangles, pyramid.triangle_attributes, pyramid.solids,
            pyramid.instances.records, pyramid.instances.nodes, pyramid.instances.materials,
            batch.rays, count, batch.stride, batch.paths, batch.starts, beams..., batch.hits);
    };
    if (scattered && scattered_)
        launch(*scattered_, (count + packets_ - 1) / packets_);
    else
        launch(closest_, (count + interleaved_ - 1) / interleaved_, batch.beams);
}

void TraceStage::begin_inside(const Pyramid& pyramid, const Surroundings& surroundings,
                              const Buffer<uint32_t>& hollow, uint32_t max_hollow, RayBatch& batch,
                              uint32_t count) {
    inside_.value().launch_packets(
        count, shape_of(pyramid), pyramid.sectors, pyramid.bricks, pyramid.leaves,
        pyramid.leaf_voxels, pyramid.attributes, pyramid.fields, pyramid.primitive_first,
        pyramid.primitives, pyramid.triangles, pyramid.triangle_attributes, pyramid.solids,
        pyramid.instances.records, pyramid.instances.nodes, pyramid.instances.materials,
        pyramid.attribute, surroundings.materials, surroundings.ranks,
        surroundings.medium_overflows, hollow, max_hollow, batch.rays, count, batch.stride,
        batch.paths, batch.starts, batch.inside);
}

void TraceStage::shadows(const Pyramid& pyramid, const Surroundings& surroundings,
                         const ShadowQueue& queue, uint32_t maximum, RayBatch& batch) {
    shadows_.launch_packets(
        (maximum + shadow_packets_ - 1) / shadow_packets_, shape_of(pyramid), pyramid.sectors,
        pyramid.bricks, pyramid.leaves, pyramid.leaf_voxels, pyramid.attributes, pyramid.fields,
        pyramid.primitive_first, pyramid.primitives, pyramid.triangles, pyramid.triangle_attributes,
        pyramid.solids, pyramid.instances.records, pyramid.instances.nodes,
        pyramid.instances.materials, pyramid.attribute, surroundings.materials, pyramid.colors,
        surroundings.ranks, surroundings.medium_overflows, surroundings.absorption,
        surroundings.density.shape, surroundings.density.bricks, surroundings.density.values,
        queue.rays, queue.count, batch.stride, queue.targets, queue.sources, batch.paths,
        batch.hits, queue.contributions, queue.beams.grid, queue.beams.ends, queue.traced,
        batch.radiance);
}

}  // namespace voxelume
