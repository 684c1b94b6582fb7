// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/display_lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/grid/grid_arguments.hpp"
#include "runtime/stages/display/display_views.hpp"

namespace voxelume {
namespace {

/// The maximum part of a point that surfaces in front may cover while the point still counts as
/// visible.
constexpr float kMaxCovered = 1 - 1.0f / 1024;

constexpr uint32_t kGroupWords = 8, kGroupBits = 256;

uint32_t group_count(const Device& device, const glm::ivec3& size) {
    const double bits = double(size.x) * double(size.y) * double(size.z);
    const double maximum =
        8 * std::min(double(device.info().max_allocation), double(UINT32_MAX) * 32);
    if (bits > maximum)
        throw Error(ErrorKind::limit,
                    "a lattice of {}x{}x{} display voxels needs a mask of {:.1f} GB, and {} allows "
                    "{:.1f} GB in one piece: use fewer display voxels",
                    size.x, size.y, size.z, bits / 8e9,
                    device.is_counting() ? "a device" : fmt::format("\"{}\"", device.info().name),
                    maximum / 8e9);
    return uint32_t((uint64_t(size.x) * uint64_t(size.y) * uint64_t(size.z) + kGroupBits - 1) /
                    kGroupBits);
}

}  // namespace

Buffer<uint32_t> allocate_display_mask(const Device& device, const glm::ivec3& size) {
    return {device, "display mask", size_t(group_count(device, size)) * kGroupWords};
}

DisplayLatticeStage::DisplayLatticeStage(const Device& device, const Features& features,
                                         const Camera& camera, const VolumeFrame& frame,
                                         const Pyramid& world)
    : device_(device),
      camera_(camera),
      lattice_(display_lattice(frame, world.frame)),
      visibility_(frame.display.visibility),
      transmission_(features.transmission),
      world_(world),
      views_(device, "display views", std::span<const float4>(ways_from_outside(world.frame))),
      groups_(group_count(device, frame.size)),
      mask_(allocate_display_mask(device, frame.size)),
      program_(device, "display/display_lattice.cl", features.defines(device)),
      aim_(program_.kernel("aim_rays")),
      objects_(program_.kernel("note_objects")),
      note_(program_.kernel("note_view")),
      mark_(program_.kernel("mark_shown")),
      count_(program_.kernel("count_groups")),
      list_(program_.kernel("list_indices")),
      choose_(program_.kernel("choose_points")),
      take_(program_.kernel("take_points")),
      keep_(program_.kernel("keep_light")) {}

void DisplayLatticeStage::aim(const ProbePoints& points, uint32_t search, uint32_t first,
                              uint32_t count, RayBatch& batch) {
    aim_.launch_packets(count, ProbeViews{camera_, shape_of(world_), lattice_, views_}, points,
                        search, first, count, batch.stride, batch.rays);
    rays_ += count;
}

void DisplayLatticeStage::leave_out_objects(const RayBatch& batch) {
    in_object_ = Buffer<uint32_t>(device_, "display points", batch.stride);
}

void DisplayLatticeStage::note_objects(const RayBatch& entries, uint32_t count, bool is_first) {
    objects_.launch(WorkItem::light, count, entries, uint32_t(is_first), count, in_object_);
}

void DisplayLatticeStage::search(const LookAhead& look, RayBatch& batch, ProbePoints& points,
                                 uint32_t view, float max_covered) {
    for (uint32_t first = 0; first < points.count; first += batch.stride) {
        const uint32_t count = std::min(batch.stride, points.count - first);
        aim(points, view + 1, first, count, batch);
        if (!in_object_.empty()) in_object_.fill(0);
        look(batch, count);
        note_.launch(WorkItem::light, count, batch.hits, batch.coverage, in_object_,
                     uint32_t(!in_object_.empty()), first, count, batch.stride, view, max_covered,
                     points.views);
    }
}

std::vector<bool> DisplayLatticeStage::are_visible(const LookAhead& look, RayBatch& batch,
                                                   std::span<const glm::vec3> points) {
    std::vector<bool> visible(points.size());
    std::vector<uint32_t> left(points.size());
    std::iota(left.begin(), left.end(), 0u);
    const bool is_observer = visibility_ == Visibility::observer;
    const uint32_t first = is_observer ? 0 : 1, end = is_observer ? 1 : uint32_t(views_.size());
    for (uint32_t view = first; view < end && !left.empty(); ++view) {
        ProbePoints probes = allocate_points(device_, uint32_t(left.size()));
        std::vector<float> coordinates(size_t(probes.total) * 3);
        for (size_t i = 0; i < left.size(); ++i)
            for (int axis = 0; axis < 3; ++axis)
                coordinates[size_t(axis) * probes.total + i] = points[left[i]][axis];
        probes.coordinates.write(coordinates);
        probes.views.fill(kNoView);
        search(look, batch, probes, view, kMaxCovered);
        const std::vector<uint32_t> views = probes.views.read();
        std::vector<uint32_t> hidden;
        for (size_t i = 0; i < left.size(); ++i) {
            visible[left[i]] = views[i] != kNoView;
            if (views[i] == kNoView) hidden.push_back(left[i]);
        }
        left = std::move(hidden);
    }
    return visible;
}

void DisplayLatticeStage::find_views(const LookAhead& look, RayBatch& batch,
                                     std::vector<ProbePoints>& pieces) {
    for (ProbePoints& points : pieces) {
        if (visibility_ != Visibility::outside) search(look, batch, points, 0, kMaxCovered);
        if (visibility_ == Visibility::observer) continue;
        // A point that is freely visible from somewhere is not lit as if seen through other
        // surfaces.
        for (const float maximum : {0.0f, kMaxCovered})
            for (uint32_t view = 1; view < views_.size() && (transmission_ || maximum == 0); ++view)
                search(look, batch, points, view, maximum);
        if (visibility_ != Visibility::all) continue;
        std::vector<uint32_t> views = points.views.read();  // a point that no view shows is lit as
                                                            // from E
        std::ranges::replace(views, kNoView, 0u);
        points.views.write(views);
    }
}

/// The point closest to the middle of each voxel, among those on lines along `axis`, or among all
/// points for -1.
ProbePoints DisplayLatticeStage::nearest(const std::vector<ProbePoints>& pieces,
                                         const ShownVoxels& shown, int axis) {
    ProbePoints chosen = allocate_points(device_, uint32_t(shown.voxels.count));
    chosen.axis = axis;
    chosen.views.fill(kNoView);
    Buffer<uint32_t> distances(device_, "display distances", chosen.count);
    Buffer<uint32_t> numbers(device_, "display numbers", chosen.count);
    distances.fill(UINT32_MAX);
    numbers.fill(UINT32_MAX);
    const auto for_pieces = [&](const auto& use) {
        uint32_t first_number = 0;
        for (const ProbePoints& points : pieces) {
            if (axis < 0 || points.axis == axis) use(points, first_number);
            first_number += points.count;
        }
    };
    for (const uint32_t turn : {0u, 1u})
        for_pieces([&](const ProbePoints& points, uint32_t first_number) {
            choose_.launch(WorkItem::light, points.count, lattice_, points, first_number, mask_,
                           shown.starts, turn, distances, numbers);
        });
    for_pieces([&](const ProbePoints& points, uint32_t first_number) {
        take_.launch(WorkItem::light, chosen.count, points, first_number, numbers, chosen.count,
                     chosen.total, chosen.coordinates, chosen.views);
    });
    return chosen;
}

ShownVoxels DisplayLatticeStage::choose(const std::vector<ProbePoints>& pieces, int samples) {
    mask_.fill(0);
    for (const ProbePoints& points : pieces)
        mark_.launch(WorkItem::light, points.count, lattice_, points, mask_);
    Buffer<uint32_t> starts(device_, "display groups", groups_);
    count_.launch(WorkItem::light, groups_, mask_, groups_, starts);
    std::vector<uint32_t> counts = starts.read();
    const uint64_t voxels = std::reduce(counts.begin(), counts.end(), uint64_t(0));
    ShownVoxels shown;
    shown.voxels = allocate_voxels(device_, voxels);
    if (voxels == 0) return shown;
    std::exclusive_scan(counts.begin(), counts.end(), counts.begin(), 0u);
    starts.write(counts);
    list_.launch(WorkItem::light, groups_, mask_, starts, groups_, shown.voxels.indices);
    shown.starts = std::move(starts);
    shown.points = nearest(pieces, shown, -1);
    for (int axis = 0; axis < 3 && samples > 1; ++axis)
        shown.of_axes[size_t(axis)] = nearest(pieces, shown, axis);
    return shown;
}

void DisplayLatticeStage::keep(const SpaceMedium& medium, const RayBatch& batch,
                               const NodeLight& nodes, const LightTask& task, uint32_t first,
                               uint32_t count, VoxelArrays& voxels) {
    keep_.launch_packets(count, camera_, shape_of(world_), medium, batch, nodes, task.targets,
                         uint32_t(!task.targets.empty()), first, count, voxels);
}

void DisplayLatticeStage::light_points(const LightRays& light_rays, const SpaceMedium& medium,
                                       RayBatch& batch, const LightTask& task,
                                       VoxelArrays& voxels) {
    for (uint32_t first = 0; first < task.points.count; first += batch.stride) {
        const uint32_t count = std::min(batch.stride, task.points.count - first);
        aim(task.points, 0, first, count, batch);
        light_nearest(light_rays, transmission_, batch, {first, count, 0, task.is_shown},
                      [&](const RayBatch& entries, const NodeLight& nodes) {
                          keep(medium, entries, nodes, task, first, count, voxels);
                      });
    }
}

/// The points of voxels that have no light yet, moved by `shift`.
DisplayLatticeStage::LightTask DisplayLatticeStage::missed_points(const ShownVoxels& shown,
                                                                  const glm::vec3& shift,
                                                                  HostPoints& host) {
    const std::vector<uint32_t> objects = shown.voxels.objects.read(0, shown.voxels.count);
    std::vector<uint32_t> missed;
    for (uint32_t voxel = 0; voxel < objects.size(); ++voxel)
        if (objects[voxel] == 0) missed.push_back(voxel);
    LightTask task;
    ProbePoints& points = task.points;
    points.count = uint32_t(missed.size());
    if (missed.empty()) return task;
    points.total = (points.count + 15) / 16 * 16;
    if (host.coordinates.empty()) {
        host.coordinates = shown.points.coordinates.read();
        host.views = shown.points.views.read();
    }
    std::vector<float> coordinates(size_t(points.total) * 3);
    std::vector<uint32_t> views(points.total, kNoView);
    for (size_t i = 0; i < missed.size(); ++i) {
        views[i] = host.views[missed[i]];
        for (int axis = 0; axis < 3; ++axis)
            coordinates[size_t(axis) * points.total + i] =
                host.coordinates[size_t(axis) * shown.points.total + missed[i]] + shift[axis];
    }
    points.coordinates =
        Buffer<float>(device_, "probe points", std::span<const float>(coordinates));
    points.views = Buffer<uint32_t>(device_, "probe views", std::span<const uint32_t>(views));
    task.targets = Buffer<uint32_t>(device_, "probe targets", std::span<const uint32_t>(missed));
    return task;
}

void DisplayLatticeStage::light(const LookAhead& look, const LightRays& light_rays,
                                const SpaceMedium& medium, RayBatch& batch, ShownVoxels& shown,
                                bool is_shown) {
    light_points(light_rays, medium, batch, {shown.points, {}, is_shown}, shown.voxels);
    HostPoints host;
    light_missed(look, light_rays, medium, batch, shown, host, is_shown);
}

void DisplayLatticeStage::light_rest(const LookAhead& look, const LightRays& light_rays,
                                     const SpaceMedium& medium, RayBatch& batch,
                                     ShownVoxels& shown) {
    HostPoints host;
    const LightTask rest = missed_points(shown, glm::vec3(0), host);
    if (rest.points.count == 0) return;
    light_points(light_rays, medium, batch, rest, shown.voxels);
    light_missed(look, light_rays, medium, batch, shown, host, true);
}

/// Lights voxels that have no light yet, by other rays. A ray that grazes the surface at its point,
/// as at an outline or along a wall, may miss the surface. Rays of other views that see the point,
/// or rays next to the first one, meet it.
void DisplayLatticeStage::light_missed(const LookAhead& look, const LightRays& light_rays,
                                       const SpaceMedium& medium, RayBatch& batch,
                                       ShownVoxels& shown, HostPoints& host, bool is_shown) {
    const auto light_shifted = [&](const glm::vec3& shift, auto&& set_views) {
        LightTask missed = missed_points(shown, shift, host);
        if (missed.points.count == 0) return false;
        missed.is_shown = is_shown;
        set_views(missed.points);
        light_points(light_rays, medium, batch, missed, shown.voxels);
        return true;
    };
    const auto look_elsewhere = [&](std::optional<float> max_covered) {
        for (uint32_t view = 1; view < views_.size(); ++view)
            if (!light_shifted(glm::vec3(0), [&](ProbePoints& points) {
                    points.views.fill(max_covered ? kNoView : view);
                    if (max_covered) search(look, batch, points, view, *max_covered);
                }))
                return;
    };
    if (visibility_ != Visibility::observer) {
        // The back of a transparent surface is seen through it, as in find_views.
        look_elsewhere(0.0f);
        if (transmission_) look_elsewhere(kMaxCovered);
    }
    for (const float by : {1.0f / 512, 1.0f / 64})
        for (int side = 0; side < 6; ++side) {
            glm::vec3 shift(0);
            shift[side / 2] = side % 2 == 0 ? by : -by;
            if (!light_shifted(shift, [](const ProbePoints&) {})) return;
        }
    if (visibility_ != Visibility::observer) look_elsewhere(std::nullopt);
}

}  // namespace voxelume
