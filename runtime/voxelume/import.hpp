// SPDX-License-Identifier: Apache-2.0
// Model files in place of scenes: a picture of a mesh or of voxels, without writing a scene.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene.hpp"
#include "values.hpp"

namespace voxelume::v1 {

/// The axis of a file that points up.
enum class UpAxis {
    automatic,  ///< Z for STL, Y for other formats that don't define it
    y,
    z
};

/// The options of a model file's scene. By default the model stands on a ground without a visible
/// end, in soft light from the observer's left, seen from the right of its front and from above; a
/// .vox is seen from the left, as in its editor.
struct ImportOptions {
    /// Direction of the observer: degrees to the right of the front; 35 by default, -40 for a .vox.
    std::optional<double> longitude{};
    /// Degrees above the horizon, -90..90; 25 by default, 30 for a .vox.
    std::optional<double> latitude{};
    double orbit = 0;       ///< degrees that are added to the longitude, also to a default one
    bool parallel = false;  ///< parallel rays, as in isometric drawings, instead of a pyramid
    /// The display is a lattice of voxels around all that is shown, for render_volume. The observer
    /// is before the front then, and there is no ground.
    bool lattice = false;
    /// The file's own camera, where it has one (glTF, .vox), is the observer, and longitude,
    /// latitude, parallel and angle don't count.
    bool own_camera = true;
    /// Name of the clip (glTF's animation) that moves the file's nodes; empty: the first.
    std::string clip{};
    /// Leaves room for turning the model: pictures of all longitudes show it from one distance.
    bool turns = false;
    double angle = 40;  ///< degrees, horizontal opening of the observer's pyramid
    /// A ground on which shadows fall, if the observer is above it. There is one by default unless
    /// the file says otherwise (.vox), has lights (glTF), or has a camera below it.
    std::optional<bool> ground{};
    /// Radiance of the background and of the ground; the file's (.vox) or grey by default.
    std::optional<Color> background{};
    /// Nothing but the model is shown: `RenderSettings::transparent`, and no ground by default.
    bool transparent = false;
    double fit = 0;  ///< metres of the longest side; 0: the file's own size
    /// Metres from voxel to voxel along X, Y and Z, before `up` turns them, instead of the file's
    /// own: for arrays, scans and files of voxels of one model. It can't be given with `fit`.
    std::optional<Vec3> spacing{};
    UpAxis up = UpAxis::automatic;  ///< axis of the file's coordinates that is up
    Size size{800, 600};            ///< size of the image, pixels
};

/// The endings of model files that `import_file` reads: ".obj", ".nii.gz" and others. For stacks of
/// numbered slices, it is "0001.png".
std::vector<std::string> model_file_endings();

/// The endings of mesh files among them: ".obj" and others.
std::vector<std::string> mesh_file_endings();

/// True if a file's name ends as those of the model files that `import_file` reads.
bool is_model_file(const std::filesystem::path& file);

/// The text of a scene that shows what a model file holds. It names the file as seen from `folder`,
/// which is the folder that the text is to be saved in, if it lies there or below, or else by its
/// name alone. Throws Error::input for a file that can't be read or has nothing to show,
/// Error::usage for another ending.
std::string import_file(const std::filesystem::path& file, const std::filesystem::path& folder,
                        const ImportOptions& options = {}, const CacheOptions& cache = {});

/// The scene of `import_file`, ready to be rendered. Throws as `import_file` and `Scene::load` do.
Scene scene_of_file(const std::filesystem::path& file, const ImportOptions& options = {},
                    const SceneOptions& scene_options = {});

/// A scene that shows voxels in memory, whose array needs a name. `fit` gives them a size; their Y
/// is up. Throws as `Scene::load` does, and as SceneOptions::voxels says.
Scene scene_of_voxels(const VoxelArray& voxels, const ImportOptions& options = {},
                      const SceneOptions& scene_options = {});

}  // namespace voxelume::v1
