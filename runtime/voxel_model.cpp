#include "runtime/voxel_model.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <sstream>

#include "kernels/shared/voxel.h"
#include "runtime/io/input_file.hpp"
#include "runtime/io/model_file.hpp"
#include "runtime/io/vdb_voxels.hpp"

namespace voxelume {
namespace {

constexpr int kMostVoxelsPerAxis = 65536;
constexpr double kMostBricks = 1 << 28;
constexpr size_t kVoxelsPerBrick = 4096, kLeavesPerBrick = 64;
constexpr int kMargin = 4;  // voxels around a volume, as around other models
constexpr const char* kSurfaceNames[] = {"cubes", "smooth", "exact"};

size_t brick_count(const GridFrame& frame) {
    const glm::ivec3 bricks = frame.bricks();
    return size_t(bricks.x) * size_t(bricks.y) * size_t(bricks.z);
}

void check_size(const glm::dvec3& size, const InputFile& file) {
    const glm::dvec3 bricks = size / double(kBrickSize) + 1.0;
    if (!(std::max({size.x, size.y, size.z}) <= kMostVoxelsPerAxis &&
          std::min({size.x, size.y, size.z}) >= 1 && bricks.x * bricks.y * bricks.z <= kMostBricks))
        file.refuse(
            fmt::format("its voxels span {} x {} x {}, at most {} along each axis and {} "
                        "bricks of 16 in all are possible",
                        size.x, size.y, size.z, kMostVoxelsPerAxis, kMostBricks));
}

/// A model file taken apart; its checksums hold, but a writer may be wrong.
class ModelReader {
  public:
    ModelReader(const InputFile& file, ModelFile content)
        : file_(file), content_(std::move(content)) {}

    VoxelModel read(Surface surface) {
        if (text("format") != "voxelume bricks 1")
            file_.refuse("has no voxels of a model that this voxelume reads");
        VoxelModel model;
        const std::string name = text("surface");
        if (name != kSurfaceNames[size_t(surface)])
            file_.refuse(fmt::format("holds a model of surface \"{}\": give it \"surface\": \"{}\"",
                                     name, name));
        model.surface = surface;
        if (surface == Surface::cubes) {
            const std::string set = text("set");
            model.set = set == "solid"  ? VoxelSet::solid
                        : set == "thin" ? VoxelSet::thin
                                        : VoxelSet::supercover;
        }
        read_frame(model.frame);
        read_bricks(model);
        std::istringstream groups(content_.header["groups"]);
        for (std::string group; std::getline(groups, group);) model.groups.push_back(group);
        if (surface == Surface::exact) read_triangles(model);
        model.transparent = std::ranges::any_of(
            model.colors, [](uint32_t c) { return c >> VXL_TRANSPARENCY_SHIFT; });
        return model;
    }

  private:
    const std::string& text(const char* key) {
        const auto found = content_.header.find(key);
        if (found == content_.header.end()) file_.refuse(fmt::format("lacks its \"{}\"", key));
        return found->second;
    }

    glm::dvec3 numbers(const char* key) {
        glm::dvec3 v;
        std::istringstream stream(text(key));
        stream >> v.x >> v.y >> v.z;
        if (!stream || !std::isfinite(v.x + v.y + v.z))
            file_.refuse(fmt::format("its \"{}\" is not three numbers", key));
        return v;
    }

    void read_frame(GridFrame& frame) {
        const glm::dvec3 size = numbers("size");
        check_size(size, file_);
        frame.size = glm::ivec3(size);
        frame.origin = numbers("origin");
        frame.voxel_edge = numbers("voxel_edge");
        if (!(std::min({frame.voxel_edge.x, frame.voxel_edge.y, frame.voxel_edge.z}) > 0))
            file_.refuse("its voxels have no size");
    }

    /// An array of `count` elements, or an empty one where the file has none and needs none.
    template <class Element>
    std::vector<Element> array(const char* name, size_t count, bool needed) {
        const auto found = content_.arrays.find(name);
        if (found == content_.arrays.end()) {
            if (needed && count > 0) file_.refuse(fmt::format("lacks its array {}", name));
            return {};
        }
        auto* values = std::get_if<std::vector<Element>>(&found->second);
        if (!values || values->size() != count)
            file_.refuse(fmt::format("its array {} doesn't fit its size", name));
        return std::move(*values);
    }

    void read_bricks(VoxelModel& model) {
        const size_t table = brick_count(model.frame);
        model.slots = array<uint32_t>("slots", table, true);
        const auto stored = size_t(
            std::ranges::count_if(model.slots, [](uint32_t slot) { return slot < kBrickInside; }));
        model.coordinates = array<uint32_t>("coordinates", stored, true);
        for (size_t slot = 0; slot < stored; ++slot) {
            const uint32_t brick = model.coordinates[slot];
            if (brick >= table || model.slots[brick] != slot)
                file_.refuse("its bricks are numbered wrongly");
        }
        const bool smooth = model.surface == Surface::smooth;
        model.occupancy =
            array<uint64_t>("occupancy", smooth ? 0 : stored * kLeavesPerBrick, !smooth);
        model.distance = array<int16_t>("distance", smooth ? stored * kVoxelsPerBrick : 0, smooth);
        model.colors = array<uint32_t>("colors", stored * kVoxelsPerBrick, false);
        if (model.surface != Surface::exact)
            model.attributes = array<uint32_t>("attributes", stored * kVoxelsPerBrick, false);
    }

    void read_triangles(VoxelModel& model) {
        const auto found = content_.arrays.find("triangles");
        const auto* corners = found == content_.arrays.end()
                                  ? nullptr
                                  : std::get_if<std::vector<float>>(&found->second);
        if (!corners || corners->empty() || corners->size() % 9 != 0)
            file_.refuse("has no whole triangles");
        Mesh& mesh = model.mesh;
        const uint32_t count = uint32_t(corners->size() / 9);
        for (uint32_t i = 0; i < 3 * count; ++i) {
            const float* p = corners->data() + 3 * size_t(i);
            if (!std::isfinite(p[0] + p[1] + p[2]))
                file_.refuse("a triangle's corner is no number");
            mesh.positions.emplace_back(model.frame.origin +
                                        model.frame.voxel_edge * glm::dvec3(p[0], p[1], p[2]));
        }
        for (uint32_t i = 0; i < count; ++i)
            mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
        mesh.group_names = model.groups;
        if (model.groups.empty()) return;
        for (const uint32_t word : array<uint32_t>("triangle_attributes", count, true))
            mesh.triangle_group.push_back(std::min(word >> VXL_MATERIAL_SHIFT & VXL_MATERIAL_MASK,
                                                   uint32_t(model.groups.size() - 1)));
    }

    const InputFile& file_;
    ModelFile content_;
};

uint32_t srgb_byte(float linear) {
    const double v = std::clamp(double(linear), 0.0, 1.0);
    const double curved = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    return uint32_t(std::lround(255 * curved));
}

/// Gives slots to the bricks of `cells` that `is_kept` keeps, in ascending order.
template <class IsKept>
void number_bricks(const std::vector<glm::ivec3>& cells, const glm::ivec3& first,
                   const IsKept& is_kept, VoxelModel& model) {
    model.slots.assign(brick_count(model.frame), kBrickOutside);
    const glm::ivec3 bricks = model.frame.bricks();
    for (size_t i = 0; i < cells.size(); ++i) {
        const glm::ivec3 b = (cells[i] - first) / kBrickSize;
        if (is_kept(i)) model.slots[b.x + size_t(bricks.x) * (b.y + size_t(bricks.y) * b.z)] = 0;
    }
    for (size_t brick = 0; brick < model.slots.size(); ++brick) {
        if (model.slots[brick] != 0) continue;
        model.slots[brick] = uint32_t(model.coordinates.size());
        model.coordinates.push_back(uint32_t(brick));
    }
}

/// Where cell `v` of the model is among its bricks' voxels.
size_t place_of(const VoxelModel& model, const glm::ivec3& v) {
    const glm::ivec3 bricks = model.frame.bricks(), b = v / kBrickSize, in = v % kBrickSize;
    const uint32_t slot = model.slots[b.x + size_t(bricks.x) * (b.y + size_t(bricks.y) * b.z)];
    return size_t(slot) * kVoxelsPerBrick + size_t(in.x | in.y << 4 | in.z << 8);
}

void fill_cubes(const VdbVoxels& voxels, const glm::ivec3& first, VoxelModel& model) {
    number_bricks(
        voxels.cells, first, [&](size_t i) { return voxels.values[i] > 0; }, model);
    model.occupancy.assign(model.coordinates.size() * kLeavesPerBrick, 0);
    const auto covers = [&](size_t i) { return std::min(voxels.values[i], 1.0f); };
    for (size_t i = 0; i < voxels.cells.size(); ++i)
        model.transparent |= voxels.values[i] > 0 && covers(i) < 1;
    if (model.transparent || !voxels.colors.empty())
        model.colors.assign(model.coordinates.size() * kVoxelsPerBrick, 0xFFFFFF);
    for (size_t i = 0; i < voxels.cells.size(); ++i) {
        if (!(voxels.values[i] > 0)) continue;
        const glm::ivec3 v = voxels.cells[i] - first, leaf = v % kBrickSize / kLeafSize,
                         in = v % kLeafSize;
        const size_t place = place_of(model, v);
        model.occupancy[place / kVoxelsPerBrick * kLeavesPerBrick +
                        size_t(leaf.x | leaf.y << 2 | leaf.z << 4)] |=
            uint64_t{1} << (in.x | in.y << 2 | in.z << 4);
        if (model.colors.empty()) continue;
        uint32_t word = 0xFFFFFF;
        if (!voxels.colors.empty()) {
            const glm::vec3& c = voxels.colors[i];
            word = srgb_byte(c.r) | srgb_byte(c.g) << 8 | srgb_byte(c.b) << 16;
        }
        const uint32_t transparency = 255 - uint32_t(std::lround(255 * covers(i)));
        model.colors[place] = word | transparency << VXL_TRANSPARENCY_SHIFT;
    }
}

void fill_distances(const VdbVoxels& voxels, const glm::ivec3& first, VoxelModel& model) {
    number_bricks(
        voxels.cells, first, [](size_t) { return true; }, model);
    const glm::ivec3 bricks = model.frame.bricks();
    for (size_t brick = 0; brick < model.slots.size(); ++brick) {
        if (model.slots[brick] != kBrickOutside) continue;
        const int index = int(brick);
        const glm::ivec3 b(index % bricks.x, index / bricks.x % bricks.y,
                           index / bricks.x / bricks.y);
        if (voxels.value_at(first + b * kBrickSize) < 0) model.slots[brick] = kBrickInside;
    }
    model.distance.resize(model.coordinates.size() * kVoxelsPerBrick);
    for (size_t slot = 0; slot < model.coordinates.size(); ++slot) {
        const int index = int(model.coordinates[slot]);
        const glm::ivec3 corner =
            first + kBrickSize * glm::ivec3(index % bricks.x, index / bricks.x % bricks.y,
                                            index / bricks.x / bricks.y);
        for (int i = 0; i < int(kVoxelsPerBrick); ++i)
            model.distance[slot * kVoxelsPerBrick + size_t(i)] =
                voxels.value_at(corner + glm::ivec3(i & 15, i >> 4 & 15, i >> 8)) < 0 ? -32767
                                                                                      : 32767;
    }
    const glm::dvec3& e = model.frame.voxel_edge;
    const double units = kDistanceUnitsPerVoxel / std::min({e.x, e.y, e.z});
    for (size_t i = 0; i < voxels.cells.size(); ++i)
        model.distance[place_of(model, voxels.cells[i] - first)] =
            int16_t(std::lround(std::clamp(voxels.values[i] * units, -32767.0, 32767.0)));
}

VoxelModel model_of(const VdbVoxels& voxels, Surface surface, const InputFile& file) {
    if (voxels.cells.empty()) file.refuse("its grid has no voxels");
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (const glm::ivec3& cell : voxels.cells) {
        low = glm::min(low, glm::dvec3(cell));
        high = glm::max(high, glm::dvec3(cell));
    }
    const glm::dvec3 size = high - low + 1.0 + 2.0 * kMargin;
    check_size(size, file);
    const glm::ivec3 first = glm::ivec3(low) - kMargin;
    VoxelModel model;
    model.surface = surface;
    model.frame.size = glm::ivec3(size);
    model.frame.voxel_edge = voxels.voxel_edges;
    // Cubes have their value in the middle, distances at the voxel's minimum corner.
    const double to_corner = surface == Surface::smooth ? 0.0 : 0.5;
    model.frame.origin = voxels.origin + voxels.voxel_edges * (glm::dvec3(first) - to_corner);
    if (surface == Surface::smooth)
        fill_distances(voxels, first, model);
    else
        fill_cubes(voxels, first, model);
    return model;
}

}  // namespace

size_t VoxelModel::voxels() const {
    size_t count = 0;
    for (const uint64_t mask : occupancy) count += size_t(std::popcount(mask));
    for (const int16_t d : distance) count += std::abs(d) < kDistanceUnitsPerVoxel;
    return count;
}

BrickGrid VoxelModel::upload(const Device& device) const {
    BrickGrid grid;
    grid.frame = frame;
    grid.brick_count = uint32_t(coordinates.size());
    grid.slots = {device, "model slots", slots};
    grid.coordinates = {device, "model coordinates", coordinates};
    grid.occupancy = {device, "model occupancy", occupancy};
    grid.distance = {device, "model distances", distance};
    grid.attributes = {device, "model attributes", attributes};
    grid.colors = {device, "model colors", colors};
    grid.transparent = transparent;
    return grid;
}

VoxelModel read_voxel_model(const std::filesystem::path& path, Surface surface) {
    const InputFile file(path);
    std::string start(std::min<uint64_t>(8, file.size()), '\0');
    file.read(0, start.data(), start.size());
    if (start == "\x89VXM\r\n\x1a\n") return ModelReader(file, read_model_file(path)).read(surface);
    if (start != std::string(" BDV\0\0\0\0", 8))
        file.refuse("is neither a .vxm nor an OpenVDB file");
    if (surface == Surface::exact)
        file.refuse("an OpenVDB file has no exact surface: give it \"cubes\" or \"smooth\"");
    return model_of(read_vdb_voxels(path, surface), surface, file);
}

}  // namespace voxelume
