// SPDX-License-Identifier: Apache-2.0
// What a file holds, as parts of a scene's text: the files' readers fill it, scene_of_file frames
// it.
#pragma once

#include <fmt/format.h>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/import/file_light.hpp"
#include "runtime/import/import_options.hpp"

namespace voxelume {

/// The observer of a file's camera.
struct FileObserver {
    std::string text;   ///< `"observer": {...}`; empty: there is none
    double height = 0;  ///< metres; the minimum over all frames
};

/// The number of light samples that a file's emissive objects have together. Local light sends a
/// ray from each point to each light sample; this is three times as many as a studio's sun has.
inline constexpr size_t kEmissiveLightSamples = 72;

struct Contents {
    std::vector<std::string> materials;  ///< members: `"name": {...}`
    std::vector<std::string> models;     ///< members
    std::vector<std::string> objects;    ///< items: `{...}`
    std::vector<std::string> tracks;     ///< items; none: nothing moves
    int frames = 1;                      ///< frames of the animation
    double fps = 24;
    FileObserver observer;
    ViewFrom from;                         ///< direction of other observers, who see all of it
    std::vector<std::string> lights;       ///< items; none: those of a studio
    std::optional<FileLight> file_light;   ///< none: the studio's own
    bool has_glass = false;                ///< shadows are to let light through
    std::vector<size_t> emissive_objects;  ///< numbers of items that emit light
    /// If there are more emissive objects, pictures are in global light.
    size_t max_locally_emissive = 16;
    Bounds box;                ///< around all that is visible, metres
    glm::dvec3 voxel_size{0};  ///< voxels of the world, metres
    glm::dvec3 lattice{0};     ///< a corner of some voxel, metres
};

/// Names that are taken, so that each new name is unique.
class NameList {
  public:
    explicit NameList(const std::vector<std::string>& taken) {
        for (const std::string& name : taken) names_.insert(name);
    }
    /// The name, with a number behind it if it is taken.
    std::string unique(const std::string& wanted);

  private:
    std::set<std::string> names_;
    std::map<std::string, int> numbers_;  ///< the last that stands behind each wanted name
};

/// A file to be shown as a scene.
struct ImportedFile {
    const std::filesystem::path& path;
    std::string name;  ///< in the scene's text
    const ImportOptions& options;
    AssetStore& assets;
};

/// The contents of a triangle mesh.
Contents mesh_contents(const ImportedFile& file);

/// The contents of a file of voxels of one model: .vxm, OpenVDB, or a format of
/// voxel_file_table.hpp.
Contents voxel_contents(const ImportedFile& file);

/// The contents of voxels in memory. The file's path and name are what the scene calls them.
Contents given_contents(const ImportedFile& file, const std::shared_ptr<const VoxelModel>& given);

/// The contents of a glTF file.
Contents gltf_contents(const ImportedFile& file);

/// The contents of a MagicaVoxel file.
Contents vox_contents(const ImportedFile& file);

/// A text in quotes, as JSON has it.
std::string json_text(std::string_view text);

/// A name in a track's target.
std::string target_name(const std::string& name);

/// "[1, 2.5, 3]".
template <class Vector>
std::string json_list(const Vector& v) {
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

/// "2", or a list where the three numbers differ.
std::string json_size(const glm::dvec3& v);

/// A number with at most this many digits, without those that binary fractions add.
double rounded(double x, int digits);
glm::dvec3 rounded(const glm::dvec3& v, int digits);

/// The file's name without folder and ending, which names what it holds.
std::string stem_of(const ImportedFile& file);

/// `, "fit": 2` where the options ask for a size.
std::string fit_member(const ImportOptions& options);

/// The size of a world's voxels for meshes in a box: 256 of them along the longest side, or 512
/// where there are textures, which show in voxels.
glm::dvec3 mesh_voxel_size(const Bounds& box, bool is_textured);

/// The size of a world's voxels for points, large enough for the points to look like a surface. The
/// contents have the size for meshes; they are `scale` times as large as the mesh.
glm::dvec3 point_voxel_size(const Mesh& mesh, const Contents& contents, double scale);

/// The members of a model that give a mesh its surface, which is shaded smooth if `is_smooth`.
std::string surface_members(const MeshSummary& mesh, bool is_smooth);

/// The box of a file's content after `fit`: around the origin.
Bounds fitted_box(const Bounds& box, const ImportOptions& options);

}  // namespace voxelume
