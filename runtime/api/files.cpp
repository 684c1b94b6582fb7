// SPDX-License-Identifier: Apache-2.0
// Voxelized meshes, frames' names and other files, for callers.
#include "runtime/voxelume/files.hpp"

#include <chrono>
#include <utility>

#include "runtime/api/border/convert.hpp"
#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/assets/cube_materials.hpp"
#include "runtime/assets/voxel_export.hpp"
#include "runtime/assets/voxel_paint.hpp"
#include "runtime/base/files/atomic_file.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/base/frame_list.hpp"
#include "runtime/base/frame_path.hpp"
#include "runtime/base/text.hpp"
#include "runtime/geometry/mesh_points.hpp"
#include "runtime/import/scene_of_file.hpp"
#include "runtime/io/gltf/gltf_mesh.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/voxel_art/cube_list.hpp"
#include "runtime/io/voxel_output_table.hpp"
#include "runtime/memory/plan.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/document/scene_fields.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"
#include "runtime/voxelume/import.hpp"
#include "runtime/world/world_cubes.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

/// True if the options ask for cubes.
bool asks_for_cubes(const v1::VoxelizeOptions& options) {
    return options.surface && shows_voxels(static_cast<Surface>(*options.surface));
}

/// The surface that the voxels of a mesh show.
Surface surface_of(const fs::path& path, const Mesh& mesh, const v1::VoxelizeOptions& options) {
    const bool has_points = has_points_alone(mesh);
    if (!options.surface) return has_points ? Surface::cubes : Surface::smooth;
    if (has_points && !asks_for_cubes(options))
        throw Error(ErrorKind::input,
                    "{}: has points and lines alone, of which nothing but cubes can be made",
                    SourcePlace(path.string()));
    return static_cast<Surface>(*options.surface);
}

/// The number of voxels along the longest side where the options give none.
int usual_resolution(const std::vector<fs::path>& outputs) {
    int voxels = 256;
    for (const fs::path& output : outputs)
        voxels = std::min(voxels, check_voxel_output(output).usual_resolution);
    return voxels;
}

/// The model that a scene would define for the mesh.
Model model_of(const fs::path& path, const Mesh& mesh, Surface surface,
               const v1::VoxelizeOptions& options, int usual) {
    Model model;
    model.name = path.stem();
    model.mesh = path;
    model.where = path.string();
    double edge = options.voxel_size;
    const bool is_scan = has_points_alone(mesh) && count_points(mesh).lines == 0;
    if (edge == 0 && options.resolution == 0 && is_scan)
        edge = voxel_edge_of_points(mesh, longest_side(mesh_bounds(mesh)) / usual);
    model.voxel_size = glm::dvec3(edge);
    if (edge == 0) model.resolution = options.resolution > 0 ? options.resolution : usual;
    model.surface = surface;
    model.set = static_cast<VoxelSet>(options.set);
    model.normals = static_cast<CubeNormals>(options.normals);
    return model;
}

void check_endings(const std::vector<fs::path>& outputs, bool has_cubes) {
    for (const fs::path& output : outputs) {
        if (check_voxel_output(output).write && !has_cubes)
            throw Error(ErrorKind::usage, "{}: files of this format hold cubes alone",
                        SourcePlace(output.string()));
    }
}

/// The materials of a mesh's groups of faces, as pictures of the file have them; nothing where the
/// file has none.
std::vector<Material> materials_of(const fs::path& path, const Mesh& mesh) {
    std::vector<Material> materials(mesh.group_names.size());
    if (materials.empty() || !is_model_file(path)) return {};
    const v1::Scene handle = v1::scene_of_file(path, {.ground = false});
    const Scene& scene = api::inside(handle);
    bool has_some = false;
    for (const Object& object : scene.objects)
        for (const GroupMaterial& entry : object.groups)
            for (size_t group = 0; group < mesh.group_names.size(); ++group) {
                if (mesh.group_names[group] != entry.group) continue;
                materials[group] = scene.materials[size_t(entry.material)];
                has_some = true;
            }
    return has_some ? materials : std::vector<Material>();
}

void add_notes(const std::vector<std::string>& notes, v1::VoxelizeReport& report) {
    report.notes.insert(report.notes.end(), notes.begin(), notes.end());
}

/// A note on what file formats of cubes alone lose where voxels aren't cubic.
std::string note_of_edges(const fs::path& output, const glm::dvec3& edge) {
    if (check_voxel_output(output).keeps_edges || (edge.x == edge.y && edge.y == edge.z)) return {};
    return fmt::format("{}: voxels of {:.4g} x {:.4g} x {:.4g} m became cubes",
                       output.filename().string(), edge.x, edge.y, edge.z);
}

/// Notes on what files of voxels that hold colours alone lose of materials.
std::vector<std::string> notes_of_materials(const std::vector<fs::path>& outputs,
                                            std::span<const CubeMaterial> materials) {
    const bool keeps = std::ranges::all_of(
        outputs, [](const fs::path& output) { return check_voxel_output(output).keeps_materials; });
    if (keeps || !has_more_than_colors(materials)) return {};
    return {
        "metal, glass, mirrors, and what gives off light became plain colours in files other "
        "than .vox"};
}

/// Notes on what is lost of the colours of a mesh's own materials and textures.
std::vector<std::string> notes_of_paint(const Mesh& mesh, std::span<const Material> materials,
                                        bool has_cubes) {
    const MeshPaint paint = paint_of(mesh);
    if (!has_cubes && (!materials.empty() || paint.textures > 0))
        return {
            "the colours of its materials and textures aren't kept: cubes keep them, and so does "
            "a scene that shows the mesh itself"};
    if (has_cubes && paint.has_alpha)
        return {"where its textures are transparent, voxels are opaque all the same"};
    return {};
}

v1::VoxelizeReport voxelize_to_files(const fs::path& path, const std::vector<fs::path>& outputs,
                                     const Device& device, const v1::VoxelizeOptions& options) {
    check_endings(outputs, asks_for_cubes(options));
    const Mesh mesh = read_mesh_file(path);
    const Model model =
        model_of(path, mesh, surface_of(path, mesh, options), options, usual_resolution(outputs));
    const GridPlan plan = plan_model(model, mesh);
    check_model(model, plan, device.info());
    const auto start = std::chrono::steady_clock::now();
    VoxelizeOptions voxels_of_model = options_of(model);
    voxels_of_model.band = kExportBand;
    const BrickGrid grid =
        Voxelizer(device).voxelize(mesh, glm::dmat4(1), plan.frame, voxels_of_model);
    device.finish();
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const VoxelExport voxels(grid, mesh, model.surface, model.set);
    v1::VoxelizeReport report{mesh.triangles.size(),
                              api::array_of(grid.frame.size),
                              grid.frame.voxel_edge.x,
                              grid.brick_count,
                              seconds,
                              {}};
    const std::vector<Material> materials = materials_of(path, mesh);
    const std::vector<CubeMaterial> finishes = cube_materials(materials, plan.frame.voxel_edge.x);
    const bool has_cubes = shows_voxels(model.surface);
    add_notes(notes_of_paint(mesh, materials, has_cubes), report);
    if (has_cubes) add_notes(notes_of_materials(outputs, finishes), report);
    const auto painted = [&] {
        VoxelModel cubes = voxels.cubes();
        if (!materials.empty()) paint_voxels(materials, grid.attribute, cubes);
        return cubes;
    };
    for (const fs::path& output : outputs) {
        if (const auto write = check_voxel_output(output).write)
            add_notes(write(output, cube_list(painted(), finishes)), report);
        else if (ending_of(output) == ".vdb" && shows_voxels(model.surface))
            VoxelExport(painted()).write_vdb(output);
        else if (ending_of(output) == ".vdb")
            voxels.write_vdb(output);
        else
            voxels.write_model(output);
    }
    return report;
}

/// Leaves out the objects of some names.
void leave_out(const std::vector<std::string>& names, Scene& scene) {
    for (const std::string& name : names) {
        if (std::erase_if(scene.objects, [&](const Object& o) { return o.name == name; }) > 0)
            continue;
        std::vector<std::string_view> known;
        known.reserve(scene.objects.size());
        for (const Object& object : scene.objects) known.emplace_back(object.name);
        throw Error(ErrorKind::usage, "{}: there is no object {} to leave out{}",
                    SourcePlace(scene.file.string()), quote(name), suggest(name, known));
    }
}

v1::VoxelizeReport voxelize_scene_to_files(const v1::Scene& handle,
                                           const std::vector<fs::path>& outputs,
                                           const Device& device,
                                           const v1::VoxelizeSceneOptions& options) {
    check_endings(outputs, true);
    const Scene& whole = api::inside(handle);
    const int frames = moves(whole) ? whole.animation.frames : 1;
    if (options.frame < 1 || options.frame > frames)
        throw Error(ErrorKind::usage, "{}: there is no frame {}: the last one is {}",
                    SourcePlace(whole.file.string()), options.frame, frames);
    Scene scene = scene_at(whole, options.frame);
    leave_out(options.without, scene);
    const auto start = std::chrono::steady_clock::now();
    VoxelModel model = world_cubes(device, scene, api::assets_of(handle, options.cache),
                                   {options.voxel_size, options.resolution});
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (const fs::path& output : outputs) check_colors(output, size_of_cubes(model));
    v1::VoxelizeReport report{0,
                              api::array_of(size_of_cubes(model)),
                              model.frame.voxel_edge.x,
                              model.coordinates.size(),
                              seconds,
                              {}};
    const std::vector<CubeMaterial> materials =
        cube_materials(scene.materials, model.frame.voxel_edge.x);
    for (const fs::path& output : outputs) {
        const auto write = check_voxel_output(output).write;
        add_notes(write ? write(output, cube_list(model, materials))
                        : write_cubes(output, VoxelExport(model)),
                  report);
        if (const std::string note = note_of_edges(output, scene.world.voxel_size); !note.empty())
            add_notes({note}, report);
    }
    add_notes(notes_of_materials(outputs, materials), report);
    return report;
}

}  // namespace

namespace v1 {

std::span<const VoxelFormat> voxel_formats() {
    static const std::vector<VoxelFormat> formats = [] {
        std::vector<VoxelFormat> rows;
        for (const VoxelOutputFormat& row : voxel_output_table())
            rows.push_back({row.ending, row.write == nullptr});
        return rows;
    }();
    return formats;
}

VoxelizeReport voxelize(const fs::path& mesh, const std::vector<fs::path>& outputs,
                        const Device& device, const VoxelizeOptions& options) {
    return api::guarded(
        [&] { return voxelize_to_files(mesh, outputs, api::inside(device), options); });
}

VoxelizeReport voxelize_scene(const Scene& scene, const std::vector<fs::path>& outputs,
                              const Device& device, const VoxelizeSceneOptions& options) {
    return api::guarded(
        [&] { return voxelize_scene_to_files(scene, outputs, api::inside(device), options); });
}

std::vector<int> parse_frame_list(const std::string& list) {
    return api::guarded([&] { return voxelume::parse_frame_list(list); });
}

std::string frame_path(const std::string& pattern, int frame, bool one_of_many) {
    return api::guarded([&] { return voxelume::frame_path(pattern, frame, one_of_many); });
}

void check_output_file(const fs::path& file) {
    api::guarded([&] {
        const AtomicFile trial(file);  // leaves nothing behind without commit()
        if (ending_of(file) == ".vdb") check_vdb_output(file);
    });
}

std::string read_file(const fs::path& file, uint64_t max_bytes) {
    return api::guarded([&] { return InputFile(file).read_all(max_bytes); });
}

void write_file(const fs::path& file, std::string_view text) {
    api::guarded([&] {
        AtomicFile output(file);
        output.write(text.data(), text.size());
        output.commit();
    });
}

std::string quote(std::string_view text) {
    return voxelume::quote(text);
}

std::string suggest(std::string_view text, std::span<const std::string_view> names) {
    return voxelume::suggest(text, names);
}

}  // namespace v1
}  // namespace voxelume
