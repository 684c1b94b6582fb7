// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxels/model_voxels.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "kernels/shared/normal.h"
#include "kernels/shared/voxel.h"
#include "runtime/base/files/input_file.hpp"
#include "runtime/geometry/mesh_normals.hpp"
#include "runtime/io/voxels/model_file.hpp"
#include "runtime/io/voxels/voxel_limits.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kMaxModelBytes = uint64_t{12} << 30;  // the sum of a file's arrays

/// Throws Error::input for arrays larger than a model may have, before memory is allocated for
/// them.
void check_arrays(const ModelSummary& summary, const InputFile& file) {
    uint64_t bytes = 0;
    for (const auto& [name, array] : summary.arrays) {
        const uint64_t left = kMaxModelBytes - bytes, each = element_bytes(array.type);
        if (array.count > left / each)
            file.refuse(fmt::format("its arrays take more than {} GiB, which are possible at most",
                                    kMaxModelBytes >> 30));
        bytes += array.count * each;
    }
}

/// Parses a model file. Its checksums have been verified, but its writer may have stored wrong
/// values.
class ModelReader {
  public:
    ModelReader(const InputFile& file, ModelFile content)
        : file_(file), content_(std::move(content)) {}

    VoxelModel read(Surface surface) {
        if (text("format") != "voxelume bricks 1")
            file_.refuse("has no voxels of a model that this voxelume reads");
        VoxelModel model;
        const std::string name = text("surface");
        if (name != kind_of(surface).name)
            file_.refuse(fmt::format("holds a model of surface \"{}\": give it \"surface\": \"{}\"",
                                     name, name));
        model.surface = surface;
        if (shows_voxels(surface)) {
            const std::string set = text("set");
            model.set = set == "solid"  ? VoxelSet::solid
                        : set == "thin" ? VoxelSet::thin
                                        : VoxelSet::supercover;
        }
        read_frame(model.frame);
        read_bricks(model);
        std::istringstream groups(content_.header["groups"]);
        for (std::string group; std::getline(groups, group);) model.groups.push_back(group);
        if (lists_primitives(surface)) read_triangles(model);
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
        check_voxel_span(size, file_);
        frame.size = glm::ivec3(size);
        frame.origin = numbers("origin");
        frame.voxel_edge = numbers("voxel_edge");
        if (!(std::min({frame.voxel_edge.x, frame.voxel_edge.y, frame.voxel_edge.z}) > 0))
            file_.refuse("its voxels have no size");
        check_reach(frame, file_);
    }

    /// The array `name` of `count` elements. It is empty if the file has none and it isn't
    /// `needed`.
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
        const size_t table = bricks_of(model.frame);
        model.slots = array<uint32_t>("slots", table, true);
        const auto stored = size_t(
            std::ranges::count_if(model.slots, [](uint32_t slot) { return slot < kBrickInside; }));
        if (stored == 0) file_.refuse("has no voxels to show");
        check_stored_bricks(stored, file_);
        model.coordinates = array<uint32_t>("coordinates", stored, true);
        for (size_t slot = 0; slot < stored; ++slot) {
            const uint32_t brick = model.coordinates[slot];
            if (brick >= table || model.slots[brick] != slot ||
                (slot > 0 && brick <= model.coordinates[slot - 1]))
                file_.refuse("its bricks are numbered wrongly");
        }
        const bool smooth = stores_distances(model.surface);
        model.occupancy =
            array<uint64_t>("occupancy", smooth ? 0 : stored * kLeavesPerBrick, !smooth);
        model.distance = array<int16_t>("distance", smooth ? stored * kVoxelsPerBrick : 0, smooth);
        if (!smooth && model.voxels() == 0) file_.refuse("has no voxels to show");
        model.colors = array<uint32_t>("colors", stored * kVoxelsPerBrick, false);
        if (shows_voxels(model.surface))
            model.normals = array<uint32_t>("normals", stored * kVoxelsPerBrick, false);
        if (!lists_primitives(model.surface))
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
        for (const uint32_t code :
             array<uint32_t>("triangle_normals", size_t(count) * VXL_TRIANGLE_NORMALS, false))
            mesh.normals.emplace_back(code == VXL_NO_NORMAL
                                          ? glm::dvec3(0)
                                          : unpacked_normal(code) / model.frame.voxel_edge);
        mesh.group_names = model.groups;
        if (model.groups.empty()) return;
        for (const uint32_t word : array<uint32_t>("triangle_attributes", count, true))
            mesh.triangle_group.push_back(std::min(word >> VXL_MATERIAL_SHIFT & VXL_MATERIAL_MASK,
                                                   uint32_t(model.groups.size() - 1)));
    }

    const InputFile& file_;
    ModelFile content_;
};

}  // namespace

VoxelModel read_model_voxels(const std::filesystem::path& path, Surface surface) {
    const InputFile file(path);
    check_arrays(read_model_summary(path), file);
    return ModelReader(file, read_model_file(path)).read(surface);
}

}  // namespace voxelume
