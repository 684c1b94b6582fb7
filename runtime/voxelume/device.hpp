// SPDX-License-Identifier: Apache-2.0
// Devices that render: a list of them, and a program's choice among them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace voxelume::v1 {

/// The kind of a device.
enum class DeviceKind { cpu, gpu, other };

/// "cpu", "gpu" or "other".
const char* name_of(DeviceKind kind);

/// The result of the test of a device's driver when it is first opened: known arithmetic, and the
/// paths of rays through a small world.
enum class SelfTest {
    unknown,  ///< the device wasn't opened yet
    passed,   ///< every bit was right
    failed    ///< the device can't render; DeviceInfo::unusable_because says what was wrong
};

/// "unknown", "passed" or "failed".
const char* name_of(SelfTest result);

/// The properties that OpenCL reports for a device, and whether Voxelume can render on it.
struct DeviceInfo {
    int index = 0;                        ///< number in list_devices(), which Device::open takes
    DeviceKind kind = DeviceKind::other;  ///< CPU, GPU or other
    std::string name{};                   ///< name that its driver gives
    std::string vendor{};                 ///< vendor that its driver gives
    std::string platform{};               ///< name of the OpenCL platform that it belongs to
    std::string platform_version{};       ///< OpenCL version of that platform
    std::string version{};                ///< OpenCL version of the device
    std::string driver{};                 ///< version of its driver
    uint64_t memory_bytes = 0;            ///< bytes of memory; at most VOXELUME_MEMORY_MB, if set
    uint64_t max_allocation_bytes = 0;  ///< bytes of one buffer; at most VOXELUME_BUFFER_MB, if set
    int compute_units = 0;              ///< compute units, as OpenCL counts them
    int lanes = 1;                      ///< rays that one work-item handles
    SelfTest self_test = SelfTest::unknown;  ///< result, kept for its driver's version
    std::string unusable_because{};          ///< the reason why it can't render; empty if it can
    std::string note{};                      ///< a note for its user; mostly empty

    /// True if it can render.
    bool is_usable() const { return unusable_because.empty(); }
};

/// Every device of every OpenCL platform, usable or not. A platform that fails is passed over, so
/// the list may be empty.
std::vector<DeviceInfo> list_devices();

/// The number of devices that share work for the selectors "all" (1) and "all/N" (N); 0 for a
/// selector of one device. Throws Error::usage for "all/" without a number.
int parts_of_all(std::string_view selector);

/// An open device. Copies are handles of the same device; it closes with the last of them.
///
/// A device serves one call of this library at a time. Different devices may serve different
/// threads at once.
class Device {
  public:
    /// Opens the device that `selector` names: "auto", "cpu", "gpu", an index of list_devices(), or
    /// a part of the name of a device or its platform. An empty selector stands for the environment
    /// variable VOXELUME_DEVICE, and without that for "auto": a GPU rather than a CPU, then the
    /// most compute units.
    ///
    /// A device with a new driver is tested first, in a third of a second or less. If its results
    /// are wrong, it is refused, and another one that matches is opened in its place.
    ///
    /// Throws Error::device when nothing matches; the sentence names the devices that exist, or the
    /// package to install.
    static Device open(std::string_view selector = {});

    /// Opens all devices that share the work: for "all" every GPU and the best CPU, for "all/N" the
    /// same with the CPU divided into N parts, for another selector the one device of `open`.
    static std::vector<Device> open_all(std::string_view selector = {});

    /// The device's properties.
    const DeviceInfo& info() const;

    /// Rays that one work-item handles on this device; VOXELUME_LANES overrides info().lanes.
    int lanes() const;

    struct Implementation;
    /// For the library's own use.
    explicit Device(std::shared_ptr<const Implementation> implementation)
        : implementation_(std::move(implementation)) {}
    /// For the library's own use.
    const Implementation& implementation() const { return *implementation_; }

  private:
    std::shared_ptr<const Implementation> implementation_;
};

}  // namespace voxelume::v1
