// SPDX-License-Identifier: Apache-2.0
// Devices listed, and opened after their drivers' self-test.
#include <optional>
#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/opencl/device_settings.hpp"
#include "runtime/opencl/platforms.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/opencl/selector.hpp"
#include "runtime/opencl/self_test/self_test.hpp"

namespace voxelume {
namespace {

/// The reason why a device with this fault isn't used.
std::string refusal_of(const std::string& fault) {
    return fault + " (VOXELUME_SELF_TEST=again has it tested again)";
}

/// The candidates with the results of earlier self-tests: kept results or, if devices are tested in
/// every process, those of this process.
std::vector<Candidate> find_tested_candidates(int lanes = 0) {
    std::vector<Candidate> candidates = find_candidates();
    const SelfTestMode mode = self_test_mode();
    if (mode == SelfTestMode::off) return candidates;
    for (Candidate& candidate : candidates) {
        DeviceInfo& info = candidate.info;
        if (!info.unusable.empty()) continue;
        const DeviceInfo as_opened = settled(info, lanes);
        const std::optional<std::string> fault =
            mode == SelfTestMode::again ? fresh_fault(as_opened) : kept_fault(as_opened);
        if (!fault) continue;
        info.self_test = fault->empty() ? SelfTest::passed : SelfTest::failed;
        if (!fault->empty()) info.unusable = refusal_of(*fault);
    }
    return candidates;
}

/// The fault that the self-test finds on a device of a new driver. A test that couldn't run is a
/// fault, too, but isn't kept: its cause may be temporary.
std::string new_fault(const Device& device) {
    try {
        std::string fault = find_fault(device);
        keep_fault(device.info(), fault);
        share_compiled_kernels(device);
        return fault;
    } catch (const Error& error) {
        const std::string text = error.what();
        return "its self-test failed: " + text.substr(0, text.find('\n'));
    }
}

/// Marks the chosen device as faulty, so that it isn't chosen again.
void refuse(const DeviceInfo& chosen, const std::string& fault,
            std::vector<Candidate>& candidates) {
    for (Candidate& candidate : candidates)
        if (candidate.info.index == chosen.index) candidate.info.unusable = refusal_of(fault);
}

}  // namespace

std::vector<DeviceInfo> list_devices() {
    std::vector<DeviceInfo> infos;
    for (Candidate& candidate : find_tested_candidates()) {
        infos.push_back(std::move(candidate.info));
        limit_memory(infos.back());
    }
    return infos;
}

std::optional<Device> Device::open_tested(const Candidate& chosen, int lanes, const Device* sibling,
                                          std::string& fault) {
    DeviceInfo info = settled(chosen.info, lanes);
    const SelfTestMode mode = self_test_mode();
    if (mode == SelfTestMode::off) return open(chosen.device, std::move(info), sibling);
    std::optional<std::string> found;
    if (mode == SelfTestMode::once) found = kept_fault(info);
    // The test has a device of its own, so that it doesn't change the counters.
    std::optional<Device> tested;
    if (!found) {
        prepare_to_compile(info);
        tested = open(chosen.device, info, sibling);
        found = new_fault(*tested);
    }
    fault = *found;
    if (!fault.empty()) return std::nullopt;
    info.self_test = SelfTest::passed;
    return open(chosen.device, std::move(info), tested ? &*tested : sibling);
}

Device Device::open(std::string_view selector, int lanes, const Device* sibling) {
    const std::string wanted = selector_or_default(selector);
    std::vector<Candidate> candidates = find_tested_candidates(lanes);
    for (std::string fault;;) {
        const Candidate& chosen = choose(candidates, wanted);
        if (std::optional<Device> device = open_tested(chosen, lanes, sibling, fault))
            return *device;
        refuse(chosen.info, fault, candidates);
    }
}

std::vector<Device> Device::open_all(std::string_view selector, int lanes) {
    const std::string wanted = selector_or_default(selector);
    const int parts = parts_of_all(wanted);
    if (parts == 0) return {open(wanted, lanes)};
    std::vector<Candidate> candidates = find_tested_candidates(lanes);
    std::vector<Device> devices;
    for (std::string fault;; devices.clear()) {
        const std::vector<Candidate> chosen = choose_all(candidates, parts);
        for (const Candidate& candidate : chosen) {
            const std::optional<Device> device = open_tested(candidate, lanes, nullptr, fault);
            if (device)
                devices.push_back(*device);
            else
                refuse(candidate.info, fault, candidates);
        }
        if (devices.size() == chosen.size()) return devices;
    }
}

}  // namespace voxelume
