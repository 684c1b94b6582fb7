// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/display_scan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "runtime/base/error.hpp"
#include "runtime/grid/grid_arguments.hpp"
#include "runtime/opencl/float4.hpp"

namespace voxelume {
namespace {

constexpr int kMaxParts = 64;

/// The numbers of lines in a voxel for measuring how much its surfaces cover: along a single axis,
/// where opacities must hold column by column, and along each of all axes.
constexpr int kColumnLines = 64, kMeanLines = 16;

int lines_along(int axis, CoverAxes axes) {
    if (axes == CoverAxes::all || axes == CoverAxes::oblique) return kMeanLines;
    return int(axes) == axis ? kColumnLines : 0;
}

/// The position of line i of `count` across a voxel. No two have the same coordinate along any
/// edge, so that outlines along the lattice's axes are sampled as evenly as others.
glm::vec2 cover_position(int i, int count) {
    constexpr double kGoldenRatio = 0.61803398874989485;
    const double down = (i + 0.5) * kGoldenRatio;
    return {(i + 0.5) / count, down - std::floor(down)};
}

/// The part of a batch whose lines are scanned together. It is small because each line has slots
/// for many crossings; if a line needs more slots, only these few lines are scanned again.
constexpr uint32_t kBatchParts = 4;

/// The number of parts into which a display voxel's edge is divided so that none is longer than a
/// voxel of the world.
int parts_of(double edge, const GridFrame& world) {
    const glm::dvec3& e = world.voxel_edge;
    const double parts = std::ceil(edge / std::min({e.x, e.y, e.z}) - 1e-6);
    return std::clamp(int(parts), 1, kMaxParts);
}

struct LineRange {
    int first, last;
};

VoxelBox box_of(const GridFrame& world) {
    return {glm::dvec3(0), glm::dvec3(world.size)};
}

/// The box around everything that the world shows.
VoxelBox box_of_objects(const Pyramid& world) {
    if (world.object_boxes.empty()) return box_of(world.frame);
    VoxelBox all{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
    for (const VoxelBox& box : world.object_boxes) {
        if (is_empty(box)) continue;
        all = {glm::min(all.low, box.low - kInfluence), glm::max(all.high, box.high + kInfluence)};
    }
    if (world.instances.empty()) return all;
    // Instances move without a new build of the world, so the boxes above may be outdated.
    const VoxelBox bounds = box_of(world.frame), &own = world.instances.box;
    const VoxelBox seen{glm::max(own.low, bounds.low), glm::min(own.high, bounds.high)};
    if (!is_empty(seen)) all = {glm::min(all.low, seen.low), glm::max(all.high, seen.high)};
    return all;
}

/// The range of numbers of the lines that meet a box of the world, across one axis of the lattice.
/// A voxel has `parts` parts along the axis, and the lattice `count`. `first` is above `last` if no
/// line meets the box.
LineRange lines_across(const float4& row, int parts, int count, const VoxelBox& box) {
    const glm::dvec3 along(row.x, row.y, row.z);
    double minimum = double(row.w), maximum = minimum;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = along[axis] * box.low[axis], high = along[axis] * box.high[axis];
        minimum += std::min(low, high);
        maximum += std::max(low, high);
    }
    // One more line on each side than the rounding of `row` can change.
    const double slack = 1 + 1e-5 * (std::abs(double(row.w)) + maximum - minimum) * parts;
    const double first = std::floor(minimum * parts - slack),
                 last = std::ceil(maximum * parts + slack);
    return {int(std::clamp(first, 0.0, count + 1.0)), int(std::clamp(last, -1.0, double(count)))};
}

void check_lines(const Camera& camera, const VolumeFrame& frame) {
    const double lines = double(camera.width) * double(camera.height);
    if (lines > double(UINT32_MAX / 2))
        throw Error(ErrorKind::limit,
                    "a lattice of {}x{}x{} display voxels is scanned along {:.3g} lines on one of "
                    "its sides, and 2^31 can be numbered: use fewer display voxels, or a smaller "
                    "display",
                    frame.size.x, frame.size.y, frame.size.z, lines);
}

}  // namespace

uint32_t scanned_lines(uint32_t rays) {
    return std::max(rays / 16 / kBatchParts, 1u) * 16;
}

DisplayScanStage::DisplayScanStage(const Device& device, const Features& features,
                                   const VolumeFrame& frame, const GridFrame& world,
                                   LineSurfaces surfaces)
    : device_(device),
      lattice_(display_lattice(frame, world)),
      seen_along_(cover_axes(frame.display)),
      families_{edge_lines(0, frame, world), edge_lines(1, frame, world),
                edge_lines(2, frame, world)},
      camera_(device, features, families_.front().camera),
      program_(device, "display/display_scan.cl", features.defines(device)),
      scan_(program_.kernel("scan_lines")),
      pack_(program_.kernel("pack_points")),
      order_(program_.kernel("order_lines")),
      surfaces_(std::move(surfaces)),
      transmission_(features.transmission) {}

DisplayScanStage::Family DisplayScanStage::edge_lines(int axis, const VolumeFrame& frame,
                                                      const GridFrame& world) const {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    return family(axis, frame, world,
                  {parts_of(frame.edge[a], world), parts_of(frame.edge[b], world)}, {0, 0});
}

DisplayScanStage::Family DisplayScanStage::family(int axis, const VolumeFrame& frame,
                                                  const GridFrame& world, const glm::ivec2& parts,
                                                  const glm::vec2& offset) const {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const glm::dmat4& map = frame.world_from_observer;
    const auto direction = [&](int i) {
        return glm::dvec3(map[i]) * frame.edge[i] / world.voxel_edge;
    };
    Family result{};
    result.axis = axis;
    result.offset = offset;
    result.parts = parts;
    const std::array rows = {lattice_.row_x, lattice_.row_y, lattice_.row_z};
    result.row_second = rows[size_t(b)];
    result.count = frame.size[b] * result.parts.y;
    const VoxelBox all = box_of(world);
    const LineRange across_a =
        lines_across(rows[size_t(a)], result.parts.x, frame.size[a] * result.parts.x, all);
    const LineRange across_b = lines_across(result.row_second, result.parts.y, result.count, all);
    result.last = {across_a.last, across_b.last};
    glm::dvec3 corner = frame.origin;
    corner[a] += (0.5 * (across_a.first + across_a.last) + double(offset.x)) / result.parts.x *
                 frame.edge[a];
    corner[b] += (0.5 * (across_b.first + across_b.last) + double(offset.y)) / result.parts.y *
                 frame.edge[b];
    const glm::dvec3 origin =
        (glm::dvec3(map * glm::dvec4(corner, 1)) - world.origin) / world.voxel_edge;
    // A box of parallel rays. Its unit of length is a part across them and a lattice voxel along
    // them.
    Camera& camera = result.camera;
    camera.origin = to_float4(origin);
    camera.origin_low =
        to_float4(origin - glm::dvec3(camera.origin.x, camera.origin.y, camera.origin.z));
    camera.axis_x = to_float4(direction(a) / double(result.parts.x));
    camera.axis_y = to_float4(direction(b) / double(result.parts.y));
    camera.axis_z = to_float4(direction(axis));
    camera.width = std::max(across_a.last - across_a.first + 1, 0);
    camera.height = std::max(across_b.last - across_b.first + 1, 0);
    check_lines(camera, frame);
    camera.half_x = 0.5f * float(camera.width);
    camera.half_y = 0.5f * float(camera.height);
    camera.frame_width = camera.width;
    camera.frame_height = camera.height;
    camera.far_plane = float(frame.size[axis]);
    camera.samples = 1;
    camera.sample_weight = 1;
    camera.shape = VXL_SHAPE_BOX;
    result.row = rows[size_t(axis)];
    return result;
}

glm::uvec2 DisplayScanStage::rows_across(const Family& family, const VoxelBox& box) {
    if (is_empty(box)) return glm::uvec2(0);
    const LineRange lines = lines_across(family.row_second, family.parts.y, family.count, box);
    // The last line is the first of an image's rows.
    const int first = std::max(family.last.y - lines.last, 0);
    const int last = std::min(family.last.y - lines.first, family.camera.height - 1);
    if (first > last) return glm::uvec2(0);
    return {uint32_t(first) / 4, uint32_t(last) / 4 + 1};
}

LinePoints DisplayScanStage::scan_batch(const Pyramid& world, const Family& family,
                                        uint32_t first_line, uint32_t count, RayBatch& batch) {
    const uint32_t stride = (count + 15) / 16 * 16;
    std::vector<uint32_t> counts;
    for (;;) {
        // Arrays that are too small are freed first, so that none is there twice.
        if (crossed_.crossings.size() < size_t(stride) * slots_) {
            crossed_.crossings = {};
            crossed_.crossings = allocate_crossings(device_, stride, slots_);
        }
        if (transmission_ && crossed_.surfaces.size() < size_t(stride) * slots_) {
            crossed_.surfaces = {};
            crossed_.surfaces = allocate_surfaces(device_, stride, slots_);
        }
        if (crossed_.counts.size() < stride)
            crossed_.counts = Buffer<uint32_t>(device_, "probe counts", stride);
        scan_.launch_packets(count, world, family.row, batch.rays, count, batch.stride, slots_,
                             stride, uint32_t(covers_), crossed_);
        counts = crossed_.counts.read(0, count);
        const uint32_t maximum = *std::ranges::max_element(counts);
        if (maximum <= slots_) break;
        slots_ = std::max(maximum, 2 * slots_);
    }
    if (transmission_) {
        order_.launch(WorkItem::light, count, count, stride, surfaces_.ranks, surfaces_.opacities,
                      crossed_);
        counts = crossed_.counts.read(0, count);
    }
    std::vector<uint32_t> starts(size_t(count) + 1);
    std::inclusive_scan(counts.begin(), counts.end(), starts.begin() + 1);
    LinePoints found;
    found.lines = count;
    ProbePoints& points = found.points = allocate_points(device_, starts.back());
    if (points.count == 0) return found;
    points.views.fill(kNoView);
    found.starts = Buffer<uint32_t>(device_, "probe starts", std::span<const uint32_t>(starts));
    if (covers_) found.surfaces = Buffer<uint32_t>(device_, "probe surfaces", points.count);
    const LineGrid lines{
        family.axis,           uint32_t(family.camera.width), family.last.x,   family.last.y,
        float(family.parts.x), float(family.parts.y),         family.offset.x, family.offset.y};
    pack_.launch(WorkItem::light, count, lines, crossed_, found.starts, first_line, count, stride,
                 points.total, points.coordinates, found.surfaces);
    return found;
}

void DisplayScanStage::scan_families(const Pyramid& world, const std::vector<Family>& families,
                                     RayBatch& batch, const PointSink& sink) {
    const VoxelBox shown = world.voxel_count == 0 ? VoxelBox{} : box_of_objects(world);
    const uint32_t batch_tiles = scanned_lines(batch.stride) / 16;
    for (const Family& family : families) {
        const Camera& camera = family.camera;
        if (camera.width == 0 || camera.height == 0) continue;
        camera_.look(camera);
        const glm::uvec2 tiles =
            rows_across(family, shown) * tile_count(camera.width, 1);  // the first, and one beyond
                                                                       // the last
        clear_lines_ += 16ull * (tile_count(camera.width, camera.height) - (tiles.y - tiles.x));
        for (uint32_t first = tiles.x; first < tiles.y; first += batch_tiles) {
            const uint32_t now = std::min(batch_tiles, tiles.y - first);
            const uint32_t count = camera_.cast(shape_of(world), first, now, batch);
            lines_ += count;
            LinePoints found = scan_batch(world, family, first * 16, count, batch);
            if (found.points.count > 0) sink(family.axis, std::move(found));
        }
    }
}

std::vector<ProbePoints> DisplayScanStage::scan(const Pyramid& world, RayBatch& batch) {
    std::vector<ProbePoints> pieces;
    scan_families(world, families_, batch, [&pieces](int axis, LinePoints found) {
        found.points.axis = axis;
        pieces.push_back(std::move(found.points));
    });
    return pieces;
}

void DisplayScanStage::scan_covers(const VolumeFrame& frame, const Pyramid& world, RayBatch& batch,
                                   const PointSink& sink) {
    covers_ = true;
    for (int axis = 0; axis < 3; ++axis) {
        const int lines = cover_lines(axis);
        std::vector<Family> families;
        families.reserve(size_t(lines));
        for (int i = 0; i < lines; ++i)
            families.push_back(family(axis, frame, world.frame, {1, 1}, cover_position(i, lines)));
        scan_families(world, families, batch, sink);
    }
    covers_ = false;
}

int DisplayScanStage::cover_lines(int axis) const {
    return lines_along(axis, seen_along_);
}

}  // namespace voxelume
