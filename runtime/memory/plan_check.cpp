// SPDX-License-Identifier: Apache-2.0
// Refuses plans that don't fit a device, and says what to do.
#include <algorithm>
#include <cmath>

#include "runtime/base/error.hpp"
#include "runtime/base/main_memory.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/memory/plan.hpp"
#include "runtime/scene/rendered_channels.hpp"

namespace voxelume {
namespace {

/// Bricks of a lattice are numbered by signed 32-bit integers.
constexpr double kMaxBricks = 2147483647.0;

/// Voxels `factor` times as large: "voxels larger than 0.002 m".
std::string larger_voxels(const glm::dvec3& edge, double factor) {
    const glm::dvec3 e = edge * factor;
    if (edge.x == edge.y && edge.y == edge.z)
        return fmt::format("voxels larger than {:.2g} m", e.x);
    return fmt::format("voxels larger than {:.2g} x {:.2g} x {:.2g} m", e.x, e.y, e.z);
}

/// `needs`: "3 GB on a device, which has 2 GB".
[[noreturn]] void refuse_world(const World& world, const std::string& needs, double factor) {
    throw Error(ErrorKind::limit, "{}: a world of {} voxels needs {}: use {}", world.where,
                size_text(world.voxels), needs, larger_voxels(world.voxel_size, factor));
}

/// The main memory that the process may take: "2 GB", or what views of a quilt leave of it.
std::string allowed_text() {
    std::string bytes = bytes_text(double(main_memory()));
    const uint64_t claimed = claimed_memory();
    if (claimed == 0) return bytes;
    return fmt::format("{} beside the {} of a quilt's views", bytes, bytes_text(double(claimed)));
}

/// The factor by which voxels must grow: tables shrink with the cube of the edge, surfaces with the
/// square.
double table_factor(double bytes, double there) {
    return 1.05 * std::cbrt(bytes / there);
}
double surface_factor(double bytes, double there) {
    return 1.05 * std::sqrt(bytes / there);
}

/// The change that makes a buffer fit into `piece` bytes.
std::string smaller_buffer(const BufferPlan& buffer, double piece, const glm::dvec3& edge) {
    switch (buffer.growth) {
        case BufferGrowth::surface:
            return "use " + larger_voxels(edge, surface_factor(buffer.bytes, piece));
        case BufferGrowth::table:
            return "use " + larger_voxels(edge, table_factor(buffer.bytes, piece));
        case BufferGrowth::triangles:
            break;
    }
    return fmt::format("use meshes with {:.2g} of the triangles", 0.95 * piece / buffer.bytes);
}

/// Refuses a buffer that is larger than the device allows in one piece; `subject` names its owner:
/// "a model".
void check_piece(const SourcePlace& place, const char* subject, const GridFrame& frame,
                 const BufferPlan& largest, const DeviceInfo& device) {
    const double piece = double(device.max_allocation);
    if (largest.bytes <= piece) return;
    throw Error(
        ErrorKind::limit,
        "{}: {} of {} voxels needs a buffer of {} for {}, and \"{}\" allows {} in one piece: "
        "{}",
        place, subject, size_text(frame.size), bytes_text(largest.bytes), largest.name, device.name,
        bytes_text(piece), smaller_buffer(largest, piece, frame.voxel_edge));
}

/// The changes that make an image and its rays take less.
std::string smaller_image(const RenderSettings& render, const RayBytes& rays) {
    std::string text = "render a smaller one";
    if (rays.minimum() < image_bytes(render)) return text;
    if (render.samples > 1) text += ", or with fewer samples a pixel";
    if (rays.depth > 0) text += ", or with less depth";
    return text;
}

void check_image(const Scene& scene, const ScenePlan& plan, const DeviceInfo& device) {
    if (!scene.render.shows_image) return;
    const double memory = double(device.memory),
                 there = std::min(memory, double(main_memory()) / 2);
    const double image = image_bytes(scene.render) + plan.rays.minimum();
    // If the image takes more than its world, larger voxels are no remedy.
    const bool crowds =
        image <= there && plan.min_image_bytes > memory && image > plan.min_image_bytes / 2;
    if (image > there || crowds)
        throw Error(ErrorKind::limit,
                    "an image of {}x{} pixels{} {} on \"{}\", {} of them for rays, where {} can be "
                    "used: {}",
                    scene.render.size.x, scene.render.size.y,
                    crowds ? " and its world need" : " needs",
                    bytes_text(crowds ? plan.min_image_bytes : image), device.name,
                    bytes_text(plan.rays.minimum()), bytes_text(there),
                    smaller_image(scene.render, plan.rays));
    const glm::dvec2 size(scene.render.size);
    const double planes = pixel_bytes(rendered_channels(scene.render)) * size.x * size.y;
    const double piece = double(device.max_allocation);
    if (planes > piece)
        throw Error(ErrorKind::limit,
                    "an image of {}x{} pixels needs a buffer of {}, and \"{}\" allows {} in one "
                    "piece: render a smaller one",
                    scene.render.size.x, scene.render.size.y, bytes_text(planes), device.name,
                    bytes_text(piece));
}

/// Refuses a volumetric image that is too large. If it takes more than its world, larger voxels are
/// no remedy.
void check_volume(const Scene& scene, const ScenePlan& plan, const DeviceInfo& device) {
    const double memory = double(device.memory), needed = plan.min_volume_bytes;
    if (!scene.render.shows_volume || needed <= memory || plan.world_bytes > needed / 2) return;
    throw Error(ErrorKind::limit,
                "a volumetric image of {} voxels needs {} on \"{}\", which has {}: send fewer rays "
                "together with VOXELUME_BATCH, or use fewer display voxels",
                size_text(scene.observer.display.voxels), bytes_text(needed), device.name,
                bytes_text(memory));
}

void check_medium(const Scene& scene, const ScenePlan& plan, const DeviceInfo& device) {
    const double bytes = plan.medium.buffer_bytes, piece = double(device.max_allocation);
    if (bytes > piece)
        throw Error(ErrorKind::limit,
                    "{}.medium: a density at each of {} voxels needs a buffer of {}, and \"{}\" "
                    "allows {} in one piece: use {}",
                    scene.world.where, size_text(scene.world.voxels), bytes_text(bytes),
                    device.name, bytes_text(piece),
                    larger_voxels(scene.world.voxel_size, table_factor(bytes, piece)));
}

}  // namespace

std::string size_text(const glm::ivec3& size) {
    return fmt::format("{}x{}x{}", size.x, size.y, size.z);
}

std::string bytes_text(double bytes) {
    if (bytes >= 1e9) return fmt::format("{:.{}f} GB", bytes / 1e9, bytes < 1e11 ? 1 : 0);
    if (bytes >= 1e6) return fmt::format("{:.{}f} MB", bytes / 1e6, bytes < 1e8 ? 1 : 0);
    return fmt::format("{:.1f} kB", bytes / 1e3);
}

void check_model(const Model& model, const GridPlan& plan, const DeviceInfo& device) {
    const double bricks = brick_table(plan.frame), memory = double(device.memory);
    if (bricks > kMaxBricks)
        throw Error(ErrorKind::limit,
                    "{}: a model of {} voxels has more than 2^31 bricks of 16x16x16: use {}",
                    model.where, size_text(plan.frame.size),
                    larger_voxels(plan.frame.voxel_edge, table_factor(bricks, kMaxBricks)));
    if (plan.minimum.made_bytes > memory)
        throw Error(
            ErrorKind::limit,
            "{}: this model of {} voxels needs {} on \"{}\", which has {}: use {}", model.where,
            size_text(plan.frame.size), bytes_text(plan.minimum.made_bytes), device.name,
            bytes_text(memory),
            larger_voxels(plan.frame.voxel_edge, surface_factor(plan.minimum.made_bytes, memory)));
    check_piece(model.where, "a model", plan.frame, plan.largest, device);
}

void check_tables(const Scene& scene, const DeviceInfo& device) {
    const World& world = scene.world;
    const GridFrame frame = world_frame(world);
    // The table has 4 bytes for each brick in one buffer, and main memory holds a copy.
    const double bricks = brick_table(frame), bytes = 4 * bricks;
    const double there = double(std::min(device.memory, device.max_allocation));
    if (bytes > there) {
        throw Error(ErrorKind::limit,
                    "{}: a world of {} voxels needs a table of {}, and \"{}\" allows {} in one "
                    "piece: use {}",
                    world.where, size_text(world.voxels), bytes_text(bytes), device.name,
                    bytes_text(there), larger_voxels(world.voxel_size, table_factor(bytes, there)));
    }
    if (bricks > kMaxBricks)
        throw Error(ErrorKind::limit,
                    "{}: a world of {} voxels has more than 2^31 bricks of 16x16x16: use {}",
                    world.where, size_text(world.voxels),
                    larger_voxels(world.voxel_size, table_factor(bricks, kMaxBricks)));
}

void check_memory(const Scene& scene, const ScenePlan& plan, const DeviceInfo& device) {
    for (const GridPlan& grid : plan.grids) {
        if (grid.object < 0)
            check_model(scene.models[size_t(grid.model)], grid, device);
        else
            check_piece(scene.objects[size_t(grid.object)].where,
                        grid.frame.size == plan.world.size ? "an object in a world"
                                                           : "an object's part of the world",
                        grid.frame, grid.largest, device);
    }
    check_medium(scene, plan, device);
    check_image(scene, plan, device);
    check_volume(scene, plan, device);
    const double memory = double(device.memory), peak = plan.min_bytes;
    if (peak > memory)
        refuse_world(scene.world,
                     fmt::format("{} on \"{}\", which has {}", bytes_text(peak), device.name,
                                 bytes_text(memory)),
                     surface_factor(peak, memory));
    const double host = rendering_bytes(plan, peak, device);
    const auto there = double(main_memory());
    if (kDriverBytes > there)
        throw Error(ErrorKind::limit,
                    "the program and its OpenCL driver take {} of main memory, of which this "
                    "process may take {}: allow it more",
                    bytes_text(kDriverBytes), allowed_text());
    const bool shares = device.kind == DeviceKind::cpu;
    const double image =
        (shares ? 3 : 2) * image_bytes(scene.render) + (shares ? plan.rays.minimum() : 0);
    if (host > there && scene.render.shows_image && image > (host - kDriverBytes) / 2)
        throw Error(ErrorKind::limit,
                    "an image of {}x{} pixels and its world need {} of main memory, of which this "
                    "process may take {}: {}",
                    scene.render.size.x, scene.render.size.y, bytes_text(host), allowed_text(),
                    smaller_image(scene.render, plan.rays));
    if (host > there)
        refuse_world(scene.world,
                     fmt::format("{} of main memory, of which this process may take {}",
                                 bytes_text(host), allowed_text()),
                     surface_factor(host, there));
    check_piece(scene.world.where, "a world", plan.world, plan.largest, device);
}

}  // namespace voxelume
