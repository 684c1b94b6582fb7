// SPDX-License-Identifier: Apache-2.0
// One device for all tests of a suite, and one folder for each test.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/api/api_environment.hpp"

namespace voxelume::v1 {

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
