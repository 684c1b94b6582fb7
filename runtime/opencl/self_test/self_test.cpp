// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/self_test/self_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "kernels/shared/scene.h"
#include "kernels/shared/self_test.h"
#include "runtime/opencl/buffer.hpp"
#include "runtime/opencl/device_call.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/opencl/self_test/known_answers.hpp"

namespace voxelume {
namespace {

constexpr const char* kFile = "self_test.cl";
constexpr uint32_t kUnanswered = 0xA5A5A5A5;

PyramidShape known_shape() {
    constexpr int kIntegerBits = std::bit_width(unsigned(VXL_KNOWN_WORLD));
    PyramidShape shape{};
    shape.size_x = shape.size_y = shape.size_z = VXL_KNOWN_WORLD;
    shape.plane_bound = std::ldexp(1.0f, kIntegerBits + 2 - 24);  // as grid_arguments.cpp has it
    shape.fixed_point = VXL_KNOWN_FIXED_POINT;
    return shape;
}

/// A bit for each cell of the world, x fastest.
std::vector<uint32_t> known_bits() {
    constexpr uint32_t kSide = VXL_KNOWN_WORLD;
    std::vector<uint32_t> words(kSide * kSide * kSide / 32 + 1, 0);
    for (const std::array<uint8_t, 3>& voxel : known_voxels()) {
        const uint32_t cell = (voxel[2] * kSide + voxel[1]) * kSide + voxel[0];
        words[cell / 32] |= 1u << cell % 32;
    }
    return words;
}

std::vector<uint32_t> questions() {
    std::vector<uint32_t> words;
    for (const KnownRow& row : known_questions())
        words.insert(words.end(), row.words.begin(), row.words.end());
    return words;
}

/// The answers before the test. Atomic operations begin with 0, the minimum with the largest
/// number.
std::vector<uint32_t> unanswered() {
    std::vector<uint32_t> words(VXL_KNOWN_ANSWERS * VXL_KNOWN_COLUMNS, kUnanswered);
    const auto atomics = words.begin() + VXL_KNOWN_ATOMICS * VXL_KNOWN_COLUMNS;
    std::fill_n(atomics, VXL_KNOWN_COLUMNS, 0);
    atomics[3] = uint32_t(std::numeric_limits<int32_t>::max());
    return words;
}

std::vector<uint32_t> ask(const Device& device) {
    const Program program(device, kFile, {{"VXL_NATIVE_DIVIDE", device.is_cpu()}});
    const auto buffer = [&device](const char* name, const std::vector<uint32_t>& words) {
        return Buffer<uint32_t>(device, name, std::span<const uint32_t>(words));
    };
    const Buffer<uint32_t> asked = buffer("questions", questions()),
                           voxels = buffer("known voxels", known_bits()),
                           answers = buffer("answers", unanswered());
    program.kernel("answer_lanes")
        .launch_packets(VXL_KNOWN_COLUMNS, asked, known_shape(), voxels, answers);
    program.kernel("answer_numbers").launch(WorkItem::light, VXL_KNOWN_COLUMNS, asked, answers);
    return answers.read();
}

}  // namespace

std::string find_fault(const Device& device) {
    static const std::string kWhat = "testing itself";
    const DeviceCall call(device.info(), "", kWhat);
    const std::vector<uint32_t> answers = ask(device);
    for (size_t row = 0; row < VXL_KNOWN_ANSWERS; ++row) {
        const KnownRow& known = known_answers()[row];
        for (size_t i = 0; i < VXL_KNOWN_COLUMNS; ++i)
            if (const uint32_t answer = answers[row * VXL_KNOWN_COLUMNS + i];
                answer != known.words[i])
                return fmt::format("its driver gets {} wrong: 0x{:08X} where 0x{:08X} is right",
                                   known.what, answer, known.words[i]);
    }
    return {};
}

}  // namespace voxelume
