// SPDX-License-Identifier: Apache-2.0
// The values of an array that are shown when no value is chosen.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "tests/api/api_fixture.hpp"
#include "tests/support/writers/array_writer.hpp"

namespace voxelume::v1 {

class ApiArrayChoice : public ApiTest {
  protected:
    /// The scene that is made of the values in a row.
    template <class Value>
    std::string scene_of(const std::string& type, const std::vector<Value>& values) {
        const std::filesystem::path file = folder / "a.npy";
        std::ofstream(file, std::ios::binary)
            << npy_bytes(type, std::to_string(values.size()) + ", 1, 1", bytes_of_values(values));
        return import_file(file, folder);
    }

    /// The file with its surface and all that is chosen: the model's part of the scene's text.
    template <class Value>
    std::string model_of(const std::string& type, const std::vector<Value>& values) {
        const std::string text = scene_of(type, values);
        const size_t first = text.find("\"voxels\":"), last = text.find('}', first);
        return first < last ? text.substr(first, last - first) : text;
    }

    template <class Value>
    std::string refusal_of(const std::string& type, const std::vector<Value>& values) {
        try {
            return "nothing was refused: " + scene_of(type, values);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            return error.what();
        }
    }
};

TEST_F(ApiArrayChoice, LabelsHaveAColourEachAndOneAloneHasNone) {
    EXPECT_EQ(model_of<int16_t>("<i2", {0, 3, 0, 7, 3}),
              R"("voxels": "a.npy", "surface": "cubes", "label": "each")");
    EXPECT_EQ(model_of<uint8_t>("|u1", {0, 1, 1, 0}), R"("voxels": "a.npy", "surface": "cubes")");
    EXPECT_EQ(model_of<float>("<f4", {0, 9, 0}), R"("voxels": "a.npy", "surface": "cubes")");
    // Only values above 0 become voxels, unless another value is asked for.
    EXPECT_EQ(model_of<int16_t>("<i2", {0, -5, -5}),
              R"("voxels": "a.npy", "surface": "cubes", "label": -5)");
}

TEST_F(ApiArrayChoice, WholeNumbersFarBelow0AreMeasured) {
    // Air, water and bone in Hounsfield's units.
    EXPECT_THAT(model_of<int16_t>("<i2", {-1000, -1000, 40, 40, 1200}),
                testing::StartsWith(R"("voxels": "a.npy", "surface": "smooth", "iso": )"));
    EXPECT_EQ(model_of<int16_t>("<i2", {-1, 3, 7}),
              R"("voxels": "a.npy", "surface": "cubes", "label": "each")");
}

TEST_F(ApiArrayChoice, FractionsHaveASmoothSurfaceBetweenTheirTwoSets) {
    const std::string text = model_of<float>("<f4", {0.25f, 0.25f, 0.5f, 3.5f, 3.75f, NAN});
    EXPECT_THAT(text, testing::StartsWith(R"("voxels": "a.npy", "surface": "smooth", "iso": )"));
    const double iso = std::stod(text.substr(text.rfind(' ')));
    EXPECT_GT(iso, 0.5);
    EXPECT_LT(iso, 3.5);
}

TEST_F(ApiArrayChoice, ValuesWithoutAnythingToShowAreRefusedWithTheReason) {
    EXPECT_THAT(refusal_of<float>("<f4", {NAN, INFINITY, NAN}),
                testing::EndsWith("a.npy: has no voxels to show: no value is finite"));
    EXPECT_THAT(refusal_of<uint8_t>("|u1", {0, 0, 0}),
                testing::EndsWith("a.npy: has no voxels to show: all values are 0"));
}

}  // namespace voxelume::v1
