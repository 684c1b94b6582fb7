// SPDX-License-Identifier: Apache-2.0
// What is in a MagicaVoxel file, and what of it isn't shown.
#include <algorithm>

#include "runtime/api/describe/describe.hpp"
#include "runtime/import/vox_sight.hpp"
#include "runtime/io/voxels/vox_voxels.hpp"

namespace voxelume::api {
namespace {

constexpr size_t kMaxRows = 1000;  // maximum length of a list

Report numbers(const glm::ivec3& v) {
    return {v.x, v.y, v.z};
}

Report models_of(const VoxFile& vox) {
    std::vector<int> uses(vox.models.size());
    for (const VoxObject& object : vox.objects)
        for (const VoxShown& shown : object.shown) ++uses[size_t(shown.model)];
    Report rows = Report::array();
    for (size_t i = 0; i < std::min(vox.models.size(), kMaxRows); ++i)
        rows.push_back({{"part", i + 1},
                        {"size", numbers(vox.models[i].size)},
                        {"voxels", vox.models[i].voxels},
                        {"objects", uses[i]}});
    return rows;
}

Report objects_of(const VoxFile& vox) {
    Report rows = Report::array();
    for (size_t i = 0; i < std::min(vox.objects.size(), kMaxRows); ++i) {
        const VoxObject& object = vox.objects[i];
        const VoxPose& pose = object.poses.front();
        rows.push_back({{"object", object.name},
                        {"part", object.shown.front().model + 1},
                        {"at", numbers(pose.translation)},
                        {"turned", pose.rotation != VoxRotation()},
                        {"mirrored", pose.rotation.is_mirrored()},
                        {"hidden", object.hidden}});
    }
    return rows;
}

/// The palette entries with a material that isn't diffuse.
Report materials_of(const VoxFile& vox, const std::array<uint64_t, 256>& uses) {
    Report rows = Report::array();
    for (int i = 1; i < 256; ++i) {
        const VoxMaterial& m = vox.materials[size_t(i)];
        if (m.kind == VoxMaterialKind::diffuse || uses[size_t(i)] == 0) continue;
        rows.push_back({{"material", material_name(vox, i)},
                        {"voxels", uses[size_t(i)]},
                        {"weight", m.weight},
                        {"roughness", m.rough},
                        {"ior", m.ior},
                        {"flux", m.flux}});
    }
    return rows;
}

Report numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Report cameras_of(const VoxFile& vox) {
    constexpr std::array kKinds = {"perspective", "free",      "orthographic",
                                   "isometric",   "panoramic", "of an unknown kind"};
    Report rows = Report::array();
    for (const VoxCamera& camera : vox.cameras) {
        if (!(camera.radius > 0)) continue;
        rows.push_back({{"camera", kKinds[size_t(camera.kind)]},
                        {"looks at", numbers(camera.focus)},
                        {"from", camera.radius},
                        {"angles", numbers(glm::dvec3(camera.pitch, camera.yaw, camera.roll))},
                        {"fov", camera.angle.value_or(vox.render.angle)},
                        {"shown", rows.empty()}});
    }
    return rows;
}

Report settings_of(const VoxRender& render) {
    Report report = {
        {"sun", render.sun}, {"sun's height", render.sun_pitch}, {"sun's turn", render.sun_yaw},
        {"sky", render.sky}, {"exposure", render.exposure},      {"ground", render.has_ground}};
    if (render.fog > 0) report["fog"] = render.fog;
    return report;
}

/// Adds notes on the render settings that a picture lacks or assumes.
void add_unlike(const VoxFile& vox, Report& list) {
    const VoxRender& render = vox.render;
    for (const std::string& name : render.not_shown) list.push_back(name);
    if (render.sky_mode == 1) list.push_back("a picture of the sky, which is one colour here");
    if (render.sky_mode == 2) list.push_back("the atmosphere of the sky, which is one colour here");
    if (render.is_there && render.sun > 0 && render.sun_pitch <= 1)
        list.push_back("a sun below the horizon");
    if (render.fog > 0) list.push_back("the fog's own density: a likely one is shown");
    const VoxCamera* camera = used_camera(vox);
    if (camera == nullptr) return;
    if (camera->kind == VoxCameraKind::other)
        list.push_back("the camera's projection, which is perspective here");
}

/// Notes on what a picture of the file lacks.
Report not_shown(const VoxFile& vox, const std::array<uint64_t, 256>& uses) {
    Report list = Report::array();
    const auto add = [&](int count, const char* what) {
        if (count > 0) list.push_back(fmt::format("{} {}", count, what));
    };
    std::array<int, 6> kinds{};
    for (size_t i = 1; i < 256; ++i)
        if (uses[i] > 0) ++kinds[size_t(vox.materials[i].kind)];
    add(kinds[size_t(VoxMaterialKind::media)], "media, of which only what they absorb is shown");
    int cut = 0;
    for (size_t i = 1; i < 256; ++i) cut += uses[i] > 0 && vox.materials[i].is_flux_cut;
    add(cut, "fluxes above 8, which are 8 here");
    const auto used = std::ranges::count_if(
        vox.cameras, [](const VoxCamera& camera) { return camera.radius > 0; });
    add(int(used) - 1, "more cameras");
    add_unlike(vox, list);
    for (const auto& [letters, count] : vox.not_read)
        add(count, letters == "NOTE"   ? "lists of palette notes"
                   : letters == "IMAP" ? "orders of the palette, which change no colour"
                                       : fmt::format("chunks {}", letters).c_str());
    return list;
}

}  // namespace

Report describe_vox(const std::filesystem::path& path) {
    const VoxFile vox = read_vox_file(path);
    const std::array<uint64_t, 256> uses = count_palette(vox);
    uint64_t voxels = 0;
    for (const VoxModel& model : vox.models) voxels += model.voxels;
    Report report = {{"kind", "MagicaVoxel file"},
                     {"version", vox.version},
                     {"voxels", voxels},
                     {"models", vox.models.size()},
                     {"objects", vox.objects.size()},
                     {"hidden objects", std::ranges::count(vox.objects, true, &VoxObject::hidden)},
                     {"layers", vox.layers},
                     {"frames", vox.frames},
                     {"palette", vox.has_palette ? "the file's" : "MagicaVoxel's"},
                     {"colors used", std::count_if(uses.begin() + 1, uses.end(),
                                                   [](uint64_t count) { return count > 0; })}};
    report["model list"] = models_of(vox);
    report["object list"] = objects_of(vox);
    if (Report rows = materials_of(vox, uses); !rows.empty())
        report["material list"] = std::move(rows);
    if (Report rows = cameras_of(vox); !rows.empty()) report["camera list"] = std::move(rows);
    if (vox.render.is_there) report["render settings"] = settings_of(vox.render);
    if (Report list = not_shown(vox, uses); !list.empty()) report["not shown"] = std::move(list);
    return report;
}

}  // namespace voxelume::api
