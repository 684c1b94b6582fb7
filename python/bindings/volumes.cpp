// SPDX-License-Identifier: Apache-2.0
// Volumetric images for Python: sparse voxels as arrays over the library's memory.
#include "bindings.hpp"

namespace voxelume_python {
namespace {

using voxelume::Volume;

const Volume& inside(const py::object& self) {
    return self.cast<const Volume&>();
}

template <class Value>
py::array list(std::span<const Value> values, const py::object& self) {
    return view(values.data(), {py::ssize_t(values.size())}, self);
}

py::array kinds(const py::object& self) {
    const auto kinds = inside(self).kinds();
    return view(reinterpret_cast<const uint8_t*>(kinds.data()), {py::ssize_t(kinds.size())}, self);
}

py::dict frame(const Volume& volume) {
    const voxelume::VolumeFrame& frame = volume.frame();
    const bool is_lattice = frame.layout == voxelume::VolumeLayout::lattice;
    return py::dict(py::arg("layout") = is_lattice ? "lattice" : "rays",
                    py::arg("size") = frame.size, py::arg("origin") = frame.origin,
                    py::arg("edge") = frame.edge, py::arg("near") = frame.near,
                    py::arg("step") = frame.step,
                    py::arg("world_from_observer") = frame.world_from_observer);
}

}  // namespace

void bind_volumes(py::module_& module) {
    py::class_<Volume>(module, "Volume",
                       "A volumetric image: sparse voxels as read-only arrays over its memory, in "
                       "ascending order of `indices`.")
        .def_static("read", &Volume::read, py::arg("file"),
                    py::call_guard<py::gil_scoped_release>(),
                    "Reads a .vdb, .exr, .nrrd or .raw/.json file that Voxelume wrote.")
        .def("__len__", &Volume::count)
        .def_property_readonly(
            "size", [](const Volume& volume) { return volume.frame().size; },
            "voxels along the three axes of the layout")
        .def_property_readonly("frame", &frame, "where the voxels are; VolumeFrame of the library")
        .def_property_readonly(
            "indices", [](const py::object& self) { return list(inside(self).indices(), self); },
            "i + size[0] * (j + size[1] * k) of each voxel")
        .def_property_readonly(
            "colors",
            [](const py::object& self) {
                const auto colors = inside(self).colors();
                return view(colors.data(), {py::ssize_t(colors.size() / 3), 3}, self);
            },
            "(n, 3): linear Rec. 709, not multiplied by the opacity")
        .def_property_readonly(
            "opacities",
            [](const py::object& self) { return list(inside(self).opacities(), self); }, "0..1")
        .def_property_readonly(
            "depths", [](const py::object& self) { return list(inside(self).depths(), self); },
            "metres from the observer")
        .def_property_readonly(
            "object_ids",
            [](const py::object& self) { return list(inside(self).object_ids(), self); },
            "from 1 on; 0: no object")
        .def_property_readonly("kinds", &kinds, "0: the medium, 1: a surface, 2: unseen")
        .def(
            "write",
            [](const Volume& volume, const std::filesystem::path& file) { volume.write(file); },
            py::arg("file"), py::call_guard<py::gil_scoped_release>(),
            "Writes a file by the format of its ending, whole or not at all.")
        .def(
            "view",
            [](const Volume& volume, double around, double above, voxelume::Size size) {
                return volume.view({around, above}, size);
            },
            py::kw_only(), py::arg("around") = 35.0, py::arg("above") = 25.0,
            py::arg("size") = voxelume::Size{1280, 1000}, py::call_guard<py::gil_scoped_release>(),
            "A sheet: the front, a view from the side, and eight slices.")
        .def(
            "write_page",
            [](const Volume& volume, const std::filesystem::path& file, double exposure) {
                volume.write_page(file, {}, exposure);
            },
            py::arg("file"), py::kw_only(), py::arg("exposure") = 0.0,
            py::call_guard<py::gil_scoped_release>(),
            "Writes a page that shows the volume in a browser, to be turned and sliced.")
        .def("__repr__", [](const Volume& volume) {
            const auto [x, y, z] = volume.frame().size;
            return "<voxelume.Volume of " + std::to_string(x) + " x " + std::to_string(y) + " x " +
                   std::to_string(z) + " voxels, " + std::to_string(volume.count()) + " listed>";
        });
}

}  // namespace voxelume_python
