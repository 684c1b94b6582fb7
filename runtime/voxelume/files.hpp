// SPDX-License-Identifier: Apache-2.0
// Files other than images and volumes: voxelized models, descriptions of files, names of frames'
// files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "device.hpp"
#include "objects.hpp"
#include "scene.hpp"

namespace voxelume::v1 {

/// The options of voxelizing a mesh.
struct VoxelizeOptions {
    double voxel_size = 0;  ///< metres; 0: `resolution` decides
    int resolution = 0;     ///< voxels along the longest side; 0: 256, or 254 where an output is a
                            ///< .vox, and for points few enough to leave no gaps between them
    std::optional<Surface> surface{};          ///< what a voxel shows; without it smooth, and
                                               ///< cubes of points and lines
    VoxelSet set = VoxelSet::supercover;       ///< voxel set, for surface `cubes`
    CubeNormals normals = CubeNormals::faces;  ///< normals of `cubes`; models (.vxm) keep them
};

/// A format of files that voxels are written to.
struct VoxelFormat {
    std::string_view ending;    ///< ending of names: ".vox"
    bool has_surfaces = false;  ///< smooth and exact surfaces as well; otherwise cubes alone
};

/// The formats that `voxelize` and `convert_voxels` write.
std::span<const VoxelFormat> voxel_formats();

/// The result of voxelizing a mesh.
struct VoxelizeReport {
    uint64_t triangles = 0;     ///< triangles of the mesh
    std::array<int, 3> size{};  ///< voxels
    double voxel_size = 0;      ///< metres
    uint64_t bricks = 0;        ///< stored bricks of 16 x 16 x 16 voxels
    double seconds = 0;         ///< seconds, without writing files
    /// Sentences on what formats couldn't hold.
    std::vector<std::string> notes{};
};

/// Voxelizes a mesh (.obj, .ply, .stl) and writes its voxels to files of `voxel_formats`: models
/// (.vxm) that scenes name, OpenVDB volumes (.vdb), or cubes for other programs.
/// Throws Error::input for a mesh that can't be read or lacks such a surface, Error::limit for one
/// that doesn't fit the device, Error::usage for another ending, Error::output.
VoxelizeReport voxelize(const std::filesystem::path& mesh,
                        const std::vector<std::filesystem::path>& outputs, const Device& device,
                        const VoxelizeOptions& options = {});

/// The options of voxelizing the world of a scene.
struct VoxelizeSceneOptions {
    double voxel_size = 0;  ///< metres; 0: `resolution` decides
    int resolution = 0;     ///< voxels along the longest side of all that is shown; 0: the scene's
    int frame = 1;          ///< frame of a scene that moves
    CacheOptions cache{};   ///< cache of models on disk
    std::vector<std::string> without{};  ///< names of objects to leave out
};

/// Writes the voxels of a scene's world to files, as `voxelize` does. All objects are cubes in it,
/// in the colours of their voxels and materials; lights and reflections aren't written. Throws as
/// `voxelize` and `render_frames` do, and Error::usage for an object that the scene doesn't have.
VoxelizeReport voxelize_scene(const Scene& scene, const std::vector<std::filesystem::path>& outputs,
                              const Device& device, const VoxelizeSceneOptions& options = {});

/// True if `convert_voxels` can write the voxels of `from` to `to`, by their names and, where these
/// don't decide, by the content of the first file. Throws Error::input for an OpenVDB file that
/// can't be read.
bool can_convert_voxels(const std::filesystem::path& from, const std::filesystem::path& to);

/// Writes the voxels of a file to a file of another of `voxel_formats`: those of a model file of
/// cubes, or, where the format holds cubes alone, the cells of a volumetric image that are at least
/// half opaque. Returns sentences on what the format couldn't hold. Throws Error::input,
/// Error::limit, Error::output.
std::vector<std::string> convert_voxels(const std::filesystem::path& from,
                                        const std::filesystem::path& to);

struct Facts;

/// The value of a fact about a file.
using Fact =
    std::variant<std::monostate, bool, int64_t, uint64_t, double, std::string, std::vector<Facts>>;

/// A fact about a file, as describe_file returns it: a value with its name, a list, or a table.
/// Elements of lists have no names.
struct Facts {
    /// Says whether facts are a value, a list or an object.
    enum class Kind { value, list, object };
    Kind kind = Kind::value;  ///< value, list or object
    std::string name{};       ///< name of the value; none in lists
    Fact value{};             ///< lists and objects have a vector of their elements and members
};

/// Describes the content of a file. The kind of file follows from its first bytes: an OpenEXR or
/// PNG image, a volumetric image, an OpenVDB volume, a voxelized model, a MagicaVoxel file, a
/// scene, or else a mesh, with the number of voxels that it would become. Returns an object whose
/// members are in the order in which people read them. Throws Error::input, and what Scene::load
/// throws for a scene, which is read with `options`.
Facts describe_file(const std::filesystem::path& file, const SceneOptions& options = {});

/// Describes the stack of slices that begins with this PNG file, whose name has a number. Returns
/// and throws as `describe_file` does.
Facts describe_slices(const std::filesystem::path& first);

/// The result of checking a file against its checksums.
enum class FileIntegrity {
    unknown,  ///< no checksums: another program wrote it, or its format has no room for them
    whole,    ///< the file has the bytes that were written
    damaged   ///< the file has other bytes
};

/// Reads all of a file and compares it with its checksums: images and volumetric images of
/// render_frames, with the data if it is a header and with the header if it has the data; models
/// (.vxm); OpenVDB volumes. Throws Error::input for a file that can't be read.
FileIntegrity verify_file(const std::filesystem::path& file);

/// The frames of a list like "1-10,20,30-60x5", in its order. Throws Error::usage.
std::vector<int> parse_frame_list(const std::string& list);

/// The name of a frame's file: the last run of # in the pattern, or a %04d, becomes the number. A
/// pattern without either gets four digits before its extension where the file is `one_of_many`,
/// behind a dot where its name ends in a digit.
std::string frame_path(const std::string& pattern, int frame, bool one_of_many);

/// Throws Error::output when no file can be made there, or not of that kind; leaves nothing behind.
void check_output_file(const std::filesystem::path& file);

/// A hash of a file's bytes, 32 hexadecimal digits; empty for a file that can't be read.
std::string hash_of_file(const std::filesystem::path& file);

/// The bytes of a file. Throws Error::input for what is missing, can't be read or isn't a plain
/// file, without waiting for data, and Error::limit for a file of more than `max_bytes`.
std::string read_file(const std::filesystem::path& file, uint64_t max_bytes);

/// Writes a file that appears whole or not at all. Throws Error::output.
void write_file(const std::filesystem::path& file, std::string_view text);

/// A text in quotes, cut to a readable length and safe for a terminal, as messages have it.
std::string quote(std::string_view text);

/// The end of a message about an unknown name: ` did you mean "brick"?` after `;`, a list of all
/// names if none is similar, or nothing.
std::string suggest(std::string_view text, std::span<const std::string_view> names);

}  // namespace voxelume::v1
