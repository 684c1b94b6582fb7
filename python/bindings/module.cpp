// SPDX-License-Identifier: Apache-2.0
// The module voxelume._native: the library's functions for Python.
#include "bindings.hpp"

namespace voxelume_python {
namespace {

/// Raises an error of the library as voxelume.Error.
void raise(const voxelume::Error& error) {
    static const char* const kKinds[] = {"",       "render", "usage", "scene", "input",
                                         "output", "device", "build", "limit"};
    const int number = error.exit_code();
    const char* kind = number >= 1 && number <= 8 ? kKinds[number] : "cancelled";
    const py::object type = py::module_::import("voxelume._errors").attr("Error");
    const py::object made =
        type(error.what(), kind, error.file(), error.line(), error.column(), error.key());
    PyErr_SetObject(type.ptr(), made.ptr());
}

}  // namespace

void bind_errors(py::module_&) {
    py::register_local_exception_translator([](std::exception_ptr exception) {
        try {
            std::rethrow_exception(exception);
        } catch (const voxelume::Error& error) {
            raise(error);
        }
    });
}

}  // namespace voxelume_python

PYBIND11_MODULE(_native, module) {
    using namespace voxelume_python;
    module.doc() = "The compiled part of voxelume.";
    module.attr("__version__") = voxelume::version();
    // Kernels that PoCL compiles are kept in Voxelume's cache, as in the program, and a damaged
    // OpenVDB file can't harm the interpreter. No helper processes compile, because a module that
    // others import should not take cores unasked, and wheels lack the helper program.
    voxelume::configure({.set_driver_environment = true, .isolate_readers = true});
    bind_errors(module);
    bind_devices(module);
    bind_scenes(module);
    bind_images(module);
    bind_volumes(module);
    bind_rendering(module);
}
