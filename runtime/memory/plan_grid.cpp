#include "runtime/memory/plan_grid.hpp"

#include <initializer_list>

namespace voxelume {
namespace {

// Bytes for each brick while voxelizing: winding numbers; with their totals and signs.
constexpr double kWindingNumbers = 8192, kWinding = 9216;

constexpr double kSlot = 4;  // bytes for each brick of a lattice, stored or not

// Bytes for each triangle while voxelizing: its corners and places in the lists of two bricks; its
// shape, where distances are measured.
constexpr double kTriangle = 32, kShape = 80;

/// Lists of an exact surface's voxels, with all that they name.
double list_bytes(const GridPlan& grid) {
    return grid.voxels * kListBytes + double(grid.triangles) * kExactTriangleBytes;
}

BufferPlan largest_of(std::initializer_list<BufferPlan> buffers) {
    BufferPlan largest;
    for (const BufferPlan& buffer : buffers) keep_larger(largest, buffer);
    return largest;
}

}  // namespace

void keep_larger(BufferPlan& largest, const BufferPlan& buffer) {
    if (buffer.bytes > largest.bytes) largest = buffer;
}

void set_minimum(GridPlan& grid, const GridPlan& minimum) {
    grid.minimum = {minimum.voxels, minimum.made_bytes, minimum.kept_bytes};
    grid.largest = minimum.largest;
}

GridExtras extras_of(const Model& model, const MeshSummary* mesh) {
    if (model.solid) return {};
    return {.attributes = mesh->group_names.size() > 1, .colors = mesh->has_colors};
}

SurfaceArea model_area(const Model& model, const MeshSummary* mesh) {
    if (mesh) return mesh->area;
    return solid_area(*model.solid, glm::dmat4(1), {model.extent.min, model.extent.max});
}

double brick_table(const GridFrame& frame) {
    const glm::dvec3 bricks(frame.bricks());
    return bricks.x * bricks.y * bricks.z;
}

GridPlan plan_grid(const Model& model, const MeshSummary* mesh, const GridFrame& frame,
                   const SurfaceExtent& extent) {
    GridPlan grid{.frame = frame,
                  .triangles = mesh ? mesh->triangles : 0,
                  .voxels = extent.voxels,
                  .bricks = extent.bricks};
    const GridExtras extras = extras_of(model, mesh);
    const bool smooth = model.surface == Surface::smooth, exact = model.surface == Surface::exact;
    const bool counts_windings = mesh && (smooth || model.set == VoxelSet::solid);
    const bool labels = extras.attributes || extras.colors;
    const double table = brick_table(frame), bricks = extent.bricks;
    const double triangles = double(grid.triangles);
    const double shapes = smooth || labels ? triangles * kShape : 0;
    const double brick = (smooth ? kDistanceBytes : kOccupancyBytes) +
                         kWordBytes * (int(extras.attributes) + int(extras.colors) + int(exact));
    grid.kept_bytes = table * kSlot + bricks * brick + (exact ? list_bytes(grid) : 0);
    grid.made_bytes = grid.kept_bytes + table * (kTableBytes - kSlot) + triangles * kTriangle +
                      shapes + bricks * (counts_windings ? kWinding : kOccupancyBytes) +
                      (labels ? bricks * kWordBytes : 0);
    if (!model.cuts.empty()) {
        // The mesh's own grids stay beside the cut one; those of the rest of space make it.
        const bool is_shell = !smooth && model.set != VoxelSet::solid;
        const double operands = (is_shell ? 2 : 1) * grid.kept_bytes;
        grid.kept_bytes += operands;
        grid.made_bytes += 2 * operands;
    }
    grid.largest =
        largest_of({{"the table of its bricks", table * kSlot, BufferGrowth::table},
                    {"its voxels", bricks * kOccupancyBytes},
                    {"its winding numbers", counts_windings ? bricks * kWindingNumbers : 0},
                    {"its distances", smooth ? bricks * kDistanceBytes : 0},
                    {"its voxels' materials and colors", labels ? bricks * kWordBytes : 0},
                    {"the starts of its voxels' lists", exact ? bricks * kWordBytes : 0},
                    {"its voxels' lists", exact ? extent.voxels * kListBytes : 0},
                    {"its triangles", triangles * (smooth ? kShape : kTriangleBytes),
                     BufferGrowth::triangles}});
    set_minimum(grid, grid);
    return grid;
}

GridPlan plan_grid(const Model& model, const MeshSummary* mesh, const SurfaceArea& area) {
    const GridFrame frame = model_frame(model, mesh);
    const double band = model.surface == Surface::smooth ? kSurfaceBand : 0;
    const auto plan_of = [&](const SurfaceArea& of) {
        return plan_grid(model, mesh, frame, surface_extent(of, glm::dmat4(1), frame, band));
    };
    GridPlan grid = plan_of(area);
    if (model.solid)
        set_minimum(grid, plan_of(min_solid_area(*model.solid, glm::dmat4(1),
                                                 {model.extent.min, model.extent.max})));
    else
        set_minimum(grid, plan_of(model.cuts.empty() ? mesh->min_area : SurfaceArea{}));
    return grid;
}

GridPlan plan_grid(const VoxelModel& voxels) {
    const auto stored = double(voxels.coordinates.size());
    const double table = brick_table(voxels.frame) * kSlot;
    const double brick = voxels.surface == Surface::smooth ? kDistanceBytes : kOccupancyBytes;
    const bool attributes = !voxels.attributes.empty(), colors = !voxels.colors.empty();
    GridPlan grid{.frame = voxels.frame, .voxels = double(voxels.voxels()), .bricks = stored};
    grid.kept_bytes = table + stored * (brick + kWordBytes * (int(attributes) + int(colors)));
    grid.made_bytes = grid.kept_bytes;
    grid.largest = largest_of(
        {{"the table of its bricks", table, BufferGrowth::table},
         {"its voxels", stored * brick},
         {"its voxels' materials and colors", attributes || colors ? stored * kWordBytes : 0}});
    set_minimum(grid, grid);
    return grid;
}

}  // namespace voxelume
