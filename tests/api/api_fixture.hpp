// SPDX-License-Identifier: Apache-2.0
// One device for all tests of a suite, and one folder for each test.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/api/api_environment.hpp"

namespace voxelume::v1 {

/// The linear value of an sRGB code of 8 bits.
inline double linear_from_code(int code) {
    const double v = code / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

class ApiTest : public testing::Test {
  protected:
    static void SetUpTestSuite() { device = new std::vector{Device::open(test_selector())}; }
    static void TearDownTestSuite() { delete device; }
    void SetUp() override {
        std::string name = (std::filesystem::temp_directory_path() / "voxelume-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder = name;
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    inline static std::vector<Device>* device = nullptr;
    std::filesystem::path folder;
};

}  // namespace voxelume::v1
