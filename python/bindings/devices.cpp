// SPDX-License-Identifier: Apache-2.0
// Devices for Python.
#include "bindings.hpp"

namespace voxelume_python {
namespace {

using voxelume::DeviceInfo;

void bind_info(py::module_& module) {
    py::class_<DeviceInfo>(module, "DeviceInfo", "What an OpenCL platform says of a device.")
        .def_readonly("index", &DeviceInfo::index, "its number, which `open_devices` takes")
        .def_property_readonly(
            "kind", [](const DeviceInfo& info) { return voxelume::name_of(info.kind); },
            "\"cpu\", \"gpu\" or \"other\"")
        .def_readonly("name", &DeviceInfo::name, "as its driver gives it")
        .def_readonly("vendor", &DeviceInfo::vendor, "as its driver gives it")
        .def_readonly("platform", &DeviceInfo::platform, "name of its OpenCL platform")
        .def_readonly("version", &DeviceInfo::version, "of OpenCL")
        .def_readonly("driver", &DeviceInfo::driver, "version of its driver")
        .def_readonly("memory_bytes", &DeviceInfo::memory_bytes, "of its memory")
        .def_readonly("compute_units", &DeviceInfo::compute_units, "as OpenCL counts them")
        .def_readonly("lanes", &DeviceInfo::lanes, "rays that one work-item carries")
        .def_property_readonly(
            "self_test", [](const DeviceInfo& info) { return voxelume::name_of(info.self_test); },
            "\"passed\", \"failed\", or \"unknown\" before it is first opened")
        .def_readonly("unusable_because", &DeviceInfo::unusable_because,
                      "why it can't render; empty when it can")
        .def_readonly("note", &DeviceInfo::note, "what its user should know; mostly empty")
        .def_property_readonly("is_usable", &DeviceInfo::is_usable, "whether it can render")
        .def("__repr__", [](const DeviceInfo& info) {
            return "<voxelume.DeviceInfo " + std::to_string(info.index) + ": " + info.name + ">";
        });
}

}  // namespace

void bind_devices(py::module_& module) {
    bind_info(module);
    py::class_<OpenDevice>(module, "Device",
                           "An open device. It serves one call at a time; others wait.")
        .def_property_readonly(
            "info", [](const OpenDevice& open) { return open.device.info(); }, "what it is")
        .def_property_readonly(
            "lanes", [](const OpenDevice& open) { return open.device.lanes(); },
            "rays that one work-item carries on this device")
        .def("__repr__", [](const OpenDevice& open) {
            return "<voxelume.Device " + open.device.info().name + ">";
        });
    module.def("limit_memory", &voxelume::limit_memory, py::arg("bytes"),
               "Has what follows take at most so much main memory, and at most as much of a "
               "device's own: what needs more raises Error. 0: as much as there is.");
    module.def("list_devices", &voxelume::list_devices, py::call_guard<py::gil_scoped_release>(),
               "Every device of every OpenCL platform, usable or not.");
    module.def(
        "open_devices",
        [](const std::string& selector) {
            const py::gil_scoped_release release;
            std::vector<OpenDevice> devices;
            for (const voxelume::Device& device : voxelume::Device::open_all(selector))
                devices.push_back({device});
            return devices;
        },
        py::arg("selector") = "",
        "Opens devices: \"auto\", \"cpu\", \"gpu\", an index of `list_devices`, a part of a name, "
        "or \"all\".\n\nWithout a selector the variable VOXELUME_DEVICE decides, or else "
        "\"auto\". Raises Error of the kind \"device\" if nothing fits.");
}

}  // namespace voxelume_python
