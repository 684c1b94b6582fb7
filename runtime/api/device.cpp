// SPDX-License-Identifier: Apache-2.0
// Devices for callers.
#include "runtime/voxelume/device.hpp"

#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/api/border/process.hpp"
#include "runtime/opencl/selector.hpp"

namespace voxelume {
namespace {

v1::Device handle_of(Device device) {
    v1::DeviceInfo info = api::info_for_callers(device.info());
    return v1::Device(std::make_shared<const v1::Device::Implementation>(
        v1::Device::Implementation{std::move(device), std::move(info)}));
}

}  // namespace

v1::DeviceInfo api::info_for_callers(const DeviceInfo& info) {
    v1::DeviceInfo result;
    result.index = info.index;
    result.kind = static_cast<v1::DeviceKind>(info.kind);
    result.name = info.name;
    result.vendor = info.vendor;
    result.platform = info.platform;
    result.platform_version = info.platform_version;
    result.version = info.version;
    result.driver = info.driver;
    result.memory_bytes = info.memory;
    result.max_allocation_bytes = info.max_allocation;
    result.compute_units = info.compute_units;
    result.lanes = info.lanes;
    result.self_test = static_cast<v1::SelfTest>(info.self_test);
    result.unusable_because = info.unusable;
    result.note = info.note;
    return result;
}

std::vector<Device> api::inside(const std::vector<v1::Device>& devices) {
    if (devices.empty()) throw Error(ErrorKind::usage, "no device is given to render on");
    std::vector<Device> result;
    result.reserve(devices.size());
    for (const v1::Device& device : devices) result.push_back(inside(device));
    return result;
}

namespace v1 {

const char* name_of(DeviceKind kind) {
    return kind == DeviceKind::cpu ? "cpu" : kind == DeviceKind::gpu ? "gpu" : "other";
}

const char* name_of(SelfTest result) {
    return result == SelfTest::passed   ? "passed"
           : result == SelfTest::failed ? "failed"
                                        : "unknown";
}

std::vector<DeviceInfo> list_devices() {
    return api::guarded([] {
        api::apply_process_options();
        std::vector<DeviceInfo> list;
        for (const voxelume::DeviceInfo& info : voxelume::list_devices())
            list.push_back(api::info_for_callers(info));
        return list;
    });
}

int parts_of_all(std::string_view selector) {
    return api::guarded([&] { return voxelume::parts_of_all(selector); });
}

Device Device::open(std::string_view selector) {
    return api::guarded([&] {
        api::apply_process_options();
        return handle_of(voxelume::Device::open(selector));
    });
}

std::vector<Device> Device::open_all(std::string_view selector) {
    return api::guarded([&] {
        api::apply_process_options();
        std::vector<Device> devices;
        for (voxelume::Device& device : voxelume::Device::open_all(selector))
            devices.push_back(handle_of(std::move(device)));
        return devices;
    });
}

const DeviceInfo& Device::info() const {
    return implementation_->info;
}

int Device::lanes() const {
    return implementation_->device.lanes();
}

}  // namespace v1
}  // namespace voxelume
