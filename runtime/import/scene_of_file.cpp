// SPDX-License-Identifier: Apache-2.0
#include "runtime/import/scene_of_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"
#include "runtime/import/contents.hpp"
#include "runtime/import/studio.hpp"
#include "runtime/io/arrays/array_files.hpp"
#include "runtime/io/voxel_file_table.hpp"
#include "runtime/scene/fitted.hpp"

namespace voxelume {
namespace {

constexpr double kFilledShare = 0.92;  // of the image: shadows need room, too
constexpr int kSamples = 4;
constexpr int kGlobalSamples = 64;
constexpr double kAmbientInside = 0.15;

struct ModelFormat {
    std::string_view ending;
    Contents (*read)(const ImportedFile& file);
    bool is_mesh = false;  ///< otherwise a file of voxels
};

constexpr std::array<ModelFormat, 8> kFormats = {{
    {".obj", mesh_contents, true},
    {".ply", mesh_contents, true},
    {".stl", mesh_contents, true},
    {".glb", gltf_contents, true},
    {".gltf", gltf_contents, true},
    {".vxm", voxel_contents},
    {".vdb", voxel_contents},
    {".vox", vox_contents},
}};

/// The reader for files of this name; null for files that aren't read.
Contents (*reader_of(const std::filesystem::path& file))(const ImportedFile&) {
    const std::string ending = ending_of(file);
    for (const ModelFormat& format : kFormats)
        if (ending == format.ending) return format.read;
    return voxel_format_named(file) != nullptr ? voxel_contents : nullptr;
}

/// A list of a scene's members or items, a line each; empty where there are none.
std::string part(std::string_view name, char open, const std::vector<std::string>& entries,
                 char close) {
    if (entries.empty()) return {};
    return fmt::format("  \"{}\": {}\n    {}\n  {},\n", name, open, fmt::join(entries, ",\n    "),
                       close);
}

/// A position, rounded to the digits that can be seen from a distance.
glm::dvec3 seen_from(const glm::dvec3& p, double distance) {
    const double step = std::pow(10.0, std::floor(std::log10(distance)) - 3);
    return rounded(glm::round(p / step) * step, 10);
}

std::string observer_text(const glm::dvec3& position, const glm::dvec3& look_at,
                          const glm::dmat3& axes, const std::string& display) {
    // Views along Y have no up direction of their own.
    const bool is_upright = std::abs(axes[2].y) > 0.999;
    return fmt::format(
        "  \"observer\": {{\"position\": {}, \"look_at\": {},{}\n"
        "               \"display\": {{{}}}}},\n",
        json_list(position), json_list(look_at),
        is_upright ? fmt::format(" \"up\": {},", json_list(rounded(axes[1], 6))) : "", display);
}

/// An observer with a pyramid who sees all of the box.
std::string pyramid_observer(const Bounds& box, const ViewFrom& from,
                             const ImportOptions& options) {
    const glm::dmat3 axes = view_axes(from);
    const double slope = std::tan(glm::radians(options.angle / 2)) * kFilledShare;
    const glm::dvec2 slopes(slope, slope * options.size.y / options.size.x);
    const glm::dvec3 position = framing_position(box, axes, slopes);
    const double distance = glm::dot(axes[2], (box.min + box.max) / 2.0 - position);
    return observer_text(seen_from(position, distance),
                         seen_from(position + distance * axes[2], distance), axes,
                         fmt::format("\"shape\": \"pyramid\", \"angle\": {}", options.angle));
}

/// An observer with parallel rays who sees all of the box. The display reaches through all of
/// `around`.
std::string parallel_observer(const Bounds& box, const Bounds& around, const ViewFrom& from,
                              const ImportOptions& options) {
    const glm::dmat3 axes = view_axes(from);
    const Bounds seen = extent_along(box, axes), all = extent_along(around, axes);
    const glm::dvec3 side = (seen.max - seen.min) / kFilledShare;
    const double aspect = double(options.size.x) / options.size.y;
    const double width = rounded(std::max(side.x, side.y * aspect), 6);
    const double depth = rounded(1.1 * (all.max.z - all.min.z), 4);
    const glm::dvec3 middle = axes * ((seen.min + seen.max) / 2.0);
    const double back = glm::dot(axes[2], middle) - all.min.z + 0.05 * depth;
    return observer_text(seen_from(middle - back * axes[2], depth), seen_from(middle, depth), axes,
                         fmt::format("\"shape\": \"box\", \"size\": [{}, {}, {}]", width,
                                     rounded(width / aspect, 6), depth));
}

/// An observer before the front whose display is a box of voxels around what is shown.
std::string lattice_observer(const Bounds& box) {
    constexpr int kDisplayVoxels = 200;  // the longest side; pages of more turn slowly
    const double edge = rounded(longest_side(box) / kDisplayVoxels, 6);
    // A voxel more on every side holds surfaces that lie on the box.
    const glm::dvec3 voxels = glm::ceil((box.max - box.min) / edge) + 2.0;
    const glm::dvec3 size = rounded(voxels * edge, 8);
    const glm::dvec3 middle = rounded((box.min + box.max) / 2.0, 8);
    return observer_text(
        middle + glm::dvec3(0, 0, size.z / 2), middle, view_axes({0, 0}),
        fmt::format("\"shape\": \"box\", \"size\": {}, \"voxels\": {},\n"
                    "                           \"layout\": \"lattice\", \"visibility\": "
                    "\"outside\"",
                    json_list(size), json_list(voxels)));
}

/// The box that encloses the content at every turn about Y.
Bounds turned_box(const Bounds& box) {
    const glm::dvec3 middle = (box.min + box.max) / 2.0, half = (box.max - box.min) / 2.0;
    const double radius = std::hypot(half.x, half.z);
    const glm::dvec3 reach(radius, half.y, radius);
    return {middle - reach, middle + reach};
}

/// The direction from which the observer looks.
ViewFrom view_from(const Contents& contents, const ImportOptions& options) {
    return {options.longitude.value_or(contents.from.longitude) + options.orbit,
            options.latitude.value_or(contents.from.latitude)};
}

/// The observer that the options ask for.
std::string observer_of(const Bounds& contents, const Bounds& around, const ViewFrom& from,
                        const ImportOptions& options) {
    const Bounds box = options.turns ? turned_box(contents) : contents;
    if (options.is_lattice) return lattice_observer(box);
    return options.is_parallel ? parallel_observer(box, around, from, options)
                               : pyramid_observer(box, from, options);
}

/// `, "bounds": {...}` where the voxels of the file don't lie on multiples of their size, as those
/// of fitted worlds do.
std::string bounds_member(const Contents& contents, const Bounds& box) {
    const glm::dvec3 offset = contents.lattice / contents.voxel_size;
    if (glm::round(offset) == offset) return {};
    const glm::dvec3 edge = contents.voxel_size;
    const glm::dvec3 low = glm::floor((box.min - contents.lattice) / edge) - double(kFittedMargin);
    const glm::dvec3 high = glm::ceil((box.max - contents.lattice) / edge) + double(kFittedMargin);
    return fmt::format(",\n            \"bounds\": {{\"min\": {}, \"max\": {}}}",
                       json_list(contents.lattice + low * edge),
                       json_list(contents.lattice + high * edge));
}

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// The objects. If several are emissive, they share kEmissiveLightSamples.
std::vector<std::string> lit_objects(const Contents& contents) {
    std::vector<std::string> objects = contents.objects;
    const size_t count = contents.emissive_objects.size();
    if (count < 2) return objects;
    for (const size_t number : contents.emissive_objects) {
        objects[number].pop_back();
        objects[number] +=
            fmt::format(", \"spots\": {}}}", std::max<size_t>(1, kEmissiveLightSamples / count));
    }
    return objects;
}

std::string scene_of(const Contents& contents, const ImportOptions& options) {
    const bool is_own = options.has_own_camera && !options.is_lattice;
    const bool has_camera = is_own && !contents.observer.text.empty();
    const bool has_lights = !contents.lights.empty();
    // A file's own camera may be in a closed room, and its lights may leave much in the dark.
    const ViewFrom from = view_from(contents, options);
    // The light on the ground isn't known beforehand, so a ground as bright as the background is
    // made only if asked for.
    ImportOptions studio_options = options;
    if (has_lights && !options.has_ground) studio_options.has_ground = false;
    // A camera below the ground would see nothing but its underside.
    if (has_camera && !options.has_ground && contents.observer.height < contents.box.min.y)
        studio_options.has_ground = false;
    Studio studio = make_studio(contents.box, contents.voxel_size, from, studio_options,
                                contents.file_light, has_camera || has_lights ? kAmbientInside : 0);
    if (has_lights) studio.sky.clear();
    std::string text = "{\n  \"voxelume\": 1,\n";
    text += fmt::format(
        "  \"world\": {{\"voxel_size\": {}, \"background\": {}, \"ambient\": {}{}{}{}}},\n",
        json_size(contents.voxel_size), json_list(studio.background), json_list(studio.ambient),
        bounds_member(contents, studio.box), studio.sky, studio.medium);
    text += part("materials", '{', joined(contents.materials, studio.materials), '}');
    text += part("models", '{', joined(contents.models, studio.models), '}');
    text += part("objects", '[', joined(lit_objects(contents), studio.objects), ']');
    const auto& lights = has_lights ? contents.lights : studio.lights;
    // Scenes without a list of lights get one.
    text += lights.empty() ? "  \"lights\": [],\n" : part("lights", '[', lights, ']');
    if (!contents.tracks.empty())
        text += fmt::format(
            "  \"animation\": {{\"frames\": {}, \"fps\": {}, \"tracks\": [\n    {}\n  ]}},\n",
            contents.frames, contents.fps, fmt::join(contents.tracks, ",\n    "));
    text +=
        has_camera ? contents.observer.text : observer_of(contents.box, studio.box, from, options);
    // Volumetric images are in local light.
    const bool is_global =
        contents.emissive_objects.size() > contents.max_locally_emissive && !options.is_lattice;
    return text + fmt::format("  \"render\": {{\"size\": [{}, {}], \"samples\": {}{}{}{}}}\n}}\n",
                              options.size.x, options.size.y, is_global ? kGlobalSamples : kSamples,
                              is_global ? ", \"light\": \"global\"" : "",
                              contents.has_glass ? ", \"shadow\": \"filtered\"" : "",
                              options.is_transparent ? ", \"transparent\": true" : "");
}

}  // namespace

std::vector<std::string> model_file_endings() {
    std::vector<std::string> endings;
    endings.reserve(std::size(kFormats) + 2 * voxel_file_table().size());
    for (const ModelFormat& format : kFormats) endings.emplace_back(format.ending);
    for (const VoxelFileFormat& format : voxel_file_table())
        for (const std::string_view ending : format.endings)
            if (!ending.empty())
                endings.push_back(fmt::format("{}{}", format.is_numbered ? "0001" : "", ending));
    return endings;
}

std::vector<std::string> mesh_file_endings() {
    std::vector<std::string> endings;
    for (const ModelFormat& format : kFormats)
        if (format.is_mesh) endings.emplace_back(format.ending);
    return endings;
}

bool is_model_file(const std::filesystem::path& file) {
    if (reader_of(file) == nullptr || is_volume_nrrd(file)) return false;
    // Pictures of Radiance end in .hdr, as the headers of scans do.
    return ending_of(file) != ".hdr" || !std::filesystem::is_regular_file(file) ||
           voxel_file_format(file) != nullptr;
}

std::string scene_of_file(const std::filesystem::path& file, const std::string& name,
                          const ImportOptions& options, AssetStore& assets) {
    const auto read = reader_of(file);
    if (!options.clip.empty() && read != gltf_contents)
        throw Error(ErrorKind::usage, "{}: only glTF files have clips; leave {} out",
                    SourcePlace(file.string()), quote(options.clip));
    if (options.spacing && read != voxel_contents)
        throw Error(ErrorKind::usage,
                    "{}: only scans, arrays and files of voxels of one model have a spacing",
                    SourcePlace(file.string()));
    if (options.spacing && options.fit > 0)
        throw Error(ErrorKind::usage, "{}: a size and a spacing; leave one of them out",
                    SourcePlace(file.string()));
    const Contents contents = read({file, name, options, assets});
    for (const glm::dvec3& end : {contents.box.min, contents.box.max})
        if (!(std::max({std::abs(end.x), std::abs(end.y), std::abs(end.z)}) <= kMaxLength))
            throw Error(ErrorKind::input, "{}: reaches farther than scenes do, which is {} m",
                        SourcePlace(file.string()), kMaxLength);
    return scene_of(contents, options);
}

std::string scene_of_voxels(const std::shared_ptr<const VoxelModel>& voxels,
                            const std::string& name, const ImportOptions& options,
                            AssetStore& assets) {
    return scene_of(given_contents({name, name, options, assets}, voxels), options);
}

}  // namespace voxelume
