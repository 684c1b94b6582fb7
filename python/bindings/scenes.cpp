// SPDX-License-Identifier: Apache-2.0
// Scenes for Python, from files, texts and arrays.
#include "bindings.hpp"

namespace voxelume_python {
namespace {

using voxelume::Scene;
using voxelume::SceneOptions;
using voxelume::VoxelArray;

/// Bytes without conversion.
using Bytes = py::array_t<uint8_t, 0>;

/// Arrays (x, y, z, 4) of bytes, by the names that models use for them. They are read in place,
/// with any strides.
using Arrays = std::map<std::string, Bytes>;

VoxelArray voxels_of(const std::string& name, const Bytes& array) {
    if (array.ndim() != 4 || array.shape(3) != 4 || (array.size() > 0 && array.strides(3) != 1))
        throw voxelume::Error(voxelume::ErrorKind::usage,
                              "\"" + name + "\": voxels are an array (x, y, z, 4) of bytes");
    constexpr py::ssize_t kMax = 1 << 30;
    VoxelArray voxels{.name = name, .rgba = array.data(), .strides = {{}}};
    for (size_t axis = 0; axis < 3; ++axis) {
        voxels.size[axis] = int(std::min(array.shape(py::ssize_t(axis)), kMax));
        (*voxels.strides)[axis] = array.strides(py::ssize_t(axis));
    }
    return voxels;
}

SceneOptions options_of(const std::vector<std::filesystem::path>& assets,
                        const std::map<std::string, std::string>& changes, const Arrays& arrays) {
    SceneOptions options{.assets = assets};
    for (const auto& [path, value] : changes)
        options.changes.push_back({.path = path, .value = value});
    for (const auto& [name, array] : arrays) options.voxels.push_back(voxels_of(name, array));
    return options;
}

voxelume::ImportOptions studio_of(const py::dict& values) {
    voxelume::ImportOptions options;
    for (const auto& [key, value] : values) {
        const auto name = key.cast<std::string>();
        if (name == "longitude")
            options.longitude = value.cast<double>();
        else if (name == "latitude")
            options.latitude = value.cast<double>();
        else if (name == "parallel")
            options.parallel = value.cast<bool>();
        else if (name == "lattice")
            options.lattice = value.cast<bool>();
        else if (name == "angle")
            options.angle = value.cast<double>();
        else if (name == "ground")
            options.ground = value.cast<bool>();
        else if (name == "background")
            options.background = value.cast<voxelume::Color>();
        else if (name == "fit")
            options.fit = value.cast<double>();
        else if (name == "size")
            options.size = value.cast<voxelume::Size>();
        else
            throw py::key_error(name);
    }
    return options;
}

void bind_scene_class(py::module_& module) {
    py::class_<Scene>(module, "Scene", "A scene that was checked. It never changes.")
        .def("with_size", &Scene::with_size, py::arg("size"),
             "Returns the scene with another image size, (width, height) in pixels.")
        .def("with_samples", &Scene::with_samples, py::arg("samples"),
             "Returns the scene with another number of sight rays a pixel, 1..4096.")
        .def("with_noise", &Scene::with_noise, py::arg("error"), py::arg("seconds") = 0.0,
             py::arg("max_samples") = 4096,
             "Returns the scene with as many samples as its images need: those of each 4 x 4 "
             "pixels are doubled until the standard error of their light is `error` of its mean, "
             "or the image's time is over.")
        .def(
            "with_light",
            [](const Scene& scene, const std::string& light) {
                if (light != "local" && light != "global")
                    throw voxelume::Error(
                        voxelume::ErrorKind::usage,
                        "light is \"local\" or \"global\", not \"" + light + "\"");
                return scene.with_light(light == "global" ? voxelume::LightMode::global
                                                          : voxelume::LightMode::local);
            },
            py::arg("light"), "Returns the scene in \"local\" or \"global\" light.")
        .def_property_readonly("size", &Scene::size, "width and height of its image, pixels")
        .def_property_readonly("frames", &Scene::frames, "of the animation; 1 without one")
        .def_property_readonly("frames_per_second", &Scene::frames_per_second, "of its animation")
        .def_property_readonly("moves", &Scene::moves, "whether any frame may differ from another")
        .def_property_readonly("object_names", &Scene::object_names,
                               "in the order of the numbers in Image.object_ids, from 1 on")
        .def("describe", &Scene::describe, "What the scene holds, in lines for people.")
        .def("__repr__", [](const Scene& scene) {
            return "<voxelume.Scene of " + std::to_string(scene.object_names().size()) +
                   " objects>";
        });
}

}  // namespace

void bind_scenes(py::module_& module) {
    bind_scene_class(module);
    module.def(
        "load_scene",
        [](const std::filesystem::path& file, const std::vector<std::filesystem::path>& assets,
           const std::map<std::string, std::string>& changes) {
            const py::gil_scoped_release release;
            const SceneOptions options = options_of(assets, changes, {});
            return voxelume::is_model_file(file) ? voxelume::scene_of_file(file, {}, options)
                                                 : Scene::load(file, options);
        },
        py::arg("file"), py::arg("assets"), py::arg("changes"), "Reads a scene or a model file.");
    module.def(
        "parse_scene",
        [](const std::string& text, const std::string& name, bool has_lines,
           const std::vector<std::filesystem::path>& assets,
           const std::map<std::string, std::string>& changes, const Arrays& arrays) {
            SceneOptions options = options_of(assets, changes, arrays);
            options.has_lines = has_lines;
            const py::gil_scoped_release release;
            return Scene::parse(text, name, options);
        },
        py::arg("text"), py::arg("name"), py::arg("has_lines"), py::arg("assets"),
        py::arg("changes"), py::arg("arrays"), "Reads the text of a scene.");
    module.def(
        "scene_of_voxels",
        [](const Bytes& array, const py::dict& studio) {
            const VoxelArray voxels = voxels_of("voxels", array);
            const voxelume::ImportOptions options = studio_of(studio);
            const py::gil_scoped_release release;
            return voxelume::scene_of_voxels(voxels, options);
        },
        py::arg("array"), py::arg("studio"),
        "A scene that shows voxels, Y up, on a ground in soft light.");
}

}  // namespace voxelume_python
