// SPDX-License-Identifier: Apache-2.0
// The common parts of the Python module.
#pragma once

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>
#include <voxelume.hpp>

namespace voxelume_python {

namespace py = pybind11;

/// An open device, and the lock that lets it serve one call at a time.
struct OpenDevice {
    voxelume::Device device;
    std::shared_ptr<std::timed_mutex> in_use = std::make_shared<std::timed_mutex>();
};

/// A read-only array over memory that `owner` keeps alive.
template <class Value>
py::array view(const Value* values, const std::vector<py::ssize_t>& shape,
               const py::object& owner) {
    py::array_t<Value> array(shape, values, owner);
    array.attr("flags").attr("writeable") = false;
    return array;
}

/// Does the work in a separate thread, without Python's lock, and stops it when the user presses
/// Ctrl-C; the call then raises KeyboardInterrupt.
template <class Work>
auto interruptibly(const Work& work) {
    std::stop_source stop;
    auto done = std::async(std::launch::async, [&] { return work(stop.get_token()); });
    std::optional<py::error_already_set> interruption;
    {
        const py::gil_scoped_release release;
        while (done.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
            const py::gil_scoped_acquire acquire;
            if (interruption || PyErr_CheckSignals() == 0) continue;
            interruption.emplace();
            stop.request_stop();
        }
    }
    if (!interruption) return done.get();
    try {
        done.get();
    } catch (const std::exception&) {
        // The user asked for the interruption, so the interruption is reported.
    }
    throw *std::move(interruption);
}

/// The channels that callers name. Throws Error::usage for a name that doesn't exist.
voxelume::Channels channels_named(const std::vector<std::string>& names);

void bind_errors(py::module_& module);
void bind_devices(py::module_& module);
void bind_scenes(py::module_& module);
void bind_images(py::module_& module);
void bind_volumes(py::module_& module);
void bind_rendering(py::module_& module);

}  // namespace voxelume_python
