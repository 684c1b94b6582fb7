// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/emitters.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <span>
#include <tuple>

#include "kernels/shared/voxel.h"
#include "runtime/scene/predicates.hpp"
#include "runtime/stages/light/emissive_pieces.hpp"
#include "runtime/stages/light/tables/alias_table.hpp"

namespace voxelume {
namespace {

/// An emitter without its probability, which is proportional to the weight.
struct WeightedEmitter {
    EmitterRecord record{};
    double weight = 0;
};

double luminance(const glm::vec3& color) {
    return glm::dot(glm::dvec3(color), glm::dvec3(0.2126, 0.7152, 0.0722));
}

/// The strict order of emitters' importance: a hash decides between equal weights, so that the
/// emitters that remain are spread over the scene.
bool matters_more(const WeightedEmitter& a, const WeightedEmitter& b) {
    const auto rank = [](const WeightedEmitter& e) {
        return std::tuple(-e.weight, emitter_hash(e.record.voxel, e.record.instance),
                          e.record.instance, e.record.voxel);
    };
    return rank(a) < rank(b);
}

void keep_brightest(std::vector<WeightedEmitter>& emitters) {
    if (emitters.size() <= kMaxEmitters) return;
    std::ranges::nth_element(emitters, emitters.begin() + kMaxEmitters, matters_more);
    emitters.resize(kMaxEmitters);
}

/// Adds the emitters of a source whose voxels have a `volume` in cubic metres. Never holds more
/// than twice the maximum number.
void add_emitters(const EmissiveSource& source, std::span<const ListedPiece> voxels,
                  uint32_t instance, double volume, std::vector<WeightedEmitter>& emitters) {
    const double side = std::pow(volume, 2.0 / 3);
    for (const auto& [xy, z_sides, voxel, packed] : voxels) {
        WeightedEmitter emitter;
        const uint32_t sides = z_sides >> 16;
        emitter.record.corner[0] = float(xy & 0xFFFFu);
        emitter.record.corner[1] = float(xy >> 16);
        emitter.record.corner[2] = float(z_sides & 0xFFFFu);
        emitter.record.instance = instance;
        emitter.record.voxel = voxel;
        emitter.record.sides = sides & 0x3Fu;
        const double open = sides & VXL_EMITTER_OF_CUBES ? std::popcount(sides & 0x3Fu) : 1;
        emitter.weight =
            luminance(source.emission[packed >> VXL_MATERIAL_SHIFT & VXL_MATERIAL_MASK]) * side *
            open;
        if (!(emitter.weight > 0)) continue;
        if (emitters.size() == 2 * kMaxEmitters) keep_brightest(emitters);
        emitters.push_back(emitter);
    }
}

double volume_of(const glm::dvec3& edge) {
    return edge.x * edge.y * edge.z;
}

std::vector<WeightedEmitter> emitters_of(const Device& device, const Features& features,
                                         const Scene& scene, const Pyramid& world) {
    std::vector<uint32_t> emissive;
    emissive.reserve(scene.objects.size());
    for (const Object& object : scene.objects) emissive.push_back(is_emissive(scene, object));
    std::vector<WeightedEmitter> emitters;
    const EmissiveSource placed = world_source(scene, world, emissive);
    if (std::ranges::count(placed.is_emissive, 0u) < std::ssize(placed.is_emissive))
        add_emitters(placed, emissive_voxels(device, features, placed), VXL_NO_INSTANCE,
                     volume_of(world.frame.voxel_edge), emitters);
    if (world.instances.empty()) return emitters;
    const std::vector<uint32_t> materials = world.instances.materials.read();
    std::map<ModelUse, std::vector<ListedPiece>> known;
    for (uint32_t i = 0; i < world.instances.list.size(); ++i) {
        const Instance& instance = world.instances.list[i];
        if (emissive[instance.object] == 0) continue;
        const ModelUse use = model_use(scene, instance, materials);
        const EmissiveSource source = model_source(scene, world, use);
        auto found = known.find(use);
        if (found == known.end())
            found = known.emplace(use, emissive_voxels(device, features, source)).first;
        const glm::dmat3 linear(scene.objects[instance.object].world_from_object);
        add_emitters(source, found->second, i,
                     std::abs(glm::determinant(linear)) *
                         volume_of(world.instances.models[instance.model].frame.voxel_edge),
                     emitters);
    }
    return emitters;
}

/// Limits the number of emitters. Their order doesn't depend on the standard library.
void limit_emitters(std::vector<WeightedEmitter>& emitters) {
    if (emitters.size() <= kMaxEmitters) return;
    keep_brightest(emitters);
    std::ranges::sort(emitters, matters_more);
}

/// `share` is the part of rays to light that go to emitters.
std::vector<EmitterRecord> records_of(const std::vector<WeightedEmitter>& emitters, double share) {
    std::vector<double> weights;
    double sum = 0;
    for (const WeightedEmitter& emitter : emitters) {
        weights.push_back(emitter.weight);
        sum += emitter.weight;
    }
    const std::vector<AliasSlot> slots = alias_table(weights);
    std::vector<EmitterRecord> records;
    for (size_t i = 0; i < emitters.size(); ++i) {
        EmitterRecord record = emitters[i].record;
        record.probability = float(share * weights[i] / sum);
        record.own_share = float(slots[i].own_share);
        record.alias = slots[i].alias;
        records.push_back(record);
    }
    return records;
}

std::vector<uint32_t> hash_table(const std::vector<EmitterRecord>& records) {
    std::vector<uint32_t> table(std::bit_ceil(2 * records.size()), VXL_NO_EMITTER);
    for (uint32_t i = 0; i < records.size(); ++i) {
        size_t slot = emitter_hash(records[i].voxel, records[i].instance) % table.size();
        while (table[slot] != VXL_NO_EMITTER) slot = (slot + 1) % table.size();
        table[slot] = i;
    }
    return table;
}

void copy_rows(const glm::dmat3& matrix, float (&to)[9]) {
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            to[3 * row + column] = float(matrix[column][row]);
}

/// The frame of voxels of a model that an affine map transforms into the world.
EmitterFrame frame_of(const glm::dmat4& world_from_object, const GridFrame& model,
                      const GridFrame& world) {
    glm::dmat3 linear(world_from_object);
    const glm::dvec3 origin =
        glm::dvec3(world_from_object * glm::dvec4(model.origin, 1)) - world.origin;
    EmitterFrame frame{};
    frame.volume = float(std::abs(glm::determinant(linear)) * volume_of(model.voxel_edge));
    for (int column = 0; column < 3; ++column)
        linear[column] = linear[column] * model.voxel_edge[column] / world.voxel_edge;
    // A voxel's diagonal is at most the sum of its edges.
    double width = 0;
    for (int column = 0; column < 3; ++column) width += glm::length(linear[column]);
    frame.width = std::nextafter(float(width), INFINITY);
    const glm::dmat3 back = glm::inverse(linear);
    copy_rows(back, frame.object_from_world);
    copy_rows(linear, frame.world_from_object);
    const glm::dvec3 center =
        glm::round(origin / world.voxel_edge + linear * (glm::dvec3(model.size) * 0.5));
    const glm::dvec3 image = back * (center - origin / world.voxel_edge);
    for (int axis = 0; axis < 3; ++axis) {
        frame.center[axis] = float(center[axis]);
        frame.image[axis] = float(image[axis]);
    }
    return frame;
}

std::vector<EmitterFrame> frames_of(const Scene& scene, const Pyramid& world) {
    EmitterFrame own{};
    copy_rows(glm::dmat3(1), own.object_from_world);
    copy_rows(glm::dmat3(1), own.world_from_object);
    own.volume = float(volume_of(world.frame.voxel_edge));
    own.width = 3;
    std::vector<EmitterFrame> frames = {own};
    for (const Instance& instance : world.instances.list)
        frames.push_back(frame_of(scene.objects[instance.object].world_from_object,
                                  world.instances.models[instance.model].frame, world.frame));
    return frames;
}

}  // namespace

double emitter_host_bytes(size_t voxels, size_t listed) {
    constexpr double kTables = 32;  // bytes of the alias table for each emitter, while it is made
    const auto emitters = double(std::min(voxels, kMaxEmitters));
    // Growing arrays have up to twice the capacity that they need, and are copied.
    const double gathered =
        3 * double(std::min(voxels, 2 * kMaxEmitters)) * sizeof(WeightedEmitter);
    return gathered + double(std::min(voxels, listed)) * sizeof(ListedPiece) +
           emitters * (2 * sizeof(EmitterRecord) + 2 * sizeof(double) + kTables + 16);
}

int emitter_feature(const RenderSettings& render) {
    if (render.light != LightMode::global || render.bounces == 0) return VXL_EMITTERS_NONE;
    switch (render.emitters) {
        case EmitterSearch::both:
            return VXL_EMITTERS_BOTH;
        case EmitterSearch::rays:
            return VXL_EMITTERS_RAYS;
        case EmitterSearch::paths:
            break;
    }
    return VXL_EMITTERS_NONE;
}

EmitterTable build_emitters(const Device& device, const Features& features, const Scene& scene,
                            const Pyramid& world) {
    EmitterTable table;
    table.is_searched = true;
    table.volume = float(volume_of(world.frame.voxel_edge));
    std::vector<WeightedEmitter> emitters = emitters_of(device, features, scene, world);
    if (emitters.empty()) return table;
    limit_emitters(emitters);
    const double share = features.sky_rays != VXL_EMITTERS_NONE ? kEmitterChanceWithSky : 1;
    const std::vector<EmitterRecord> records = records_of(emitters, share);
    const std::vector<uint32_t> slots = hash_table(records);
    table.count = uint32_t(records.size());
    table.slots = uint32_t(slots.size());
    table.records = Buffer<EmitterRecord>(device, "emitters", std::span(records));
    table.table = Buffer<uint32_t>(device, "emitters", std::span(slots));
    if (features.instances) {
        const std::vector<EmitterFrame> frames = frames_of(scene, world);
        table.frames = Buffer<EmitterFrame>(device, "emitters", std::span(frames));
    }
    return table;
}

}  // namespace voxelume
