// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <xxhash.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/io/volume/volume_damage.hpp"
#include "tests/support/volume_samples.hpp"

namespace voxelume {

namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class VolumeRawTest : public FileTest {
  protected:
    std::filesystem::path data() const { return folder / "a.raw"; }
    std::filesystem::path header() const { return folder / "a.json"; }
    Json read_header() const { return Json::parse(bytes_of(header())); }
};

TEST_F(VolumeRawTest, EveryBitComesBackByEitherName) {
    for (const Volume& volume :
         {lattice_volume(), rays_volume(), rays_volume(DisplayShape::sector)}) {
        write_volume(data(), volume);
        expect_same_volume(read_volume(header()), volume);
        write_volume(header(), volume);
        expect_same_volume(read_volume(data()), volume);
        EXPECT_EQ(files_in_folder(), 2u);
    }
}

TEST_F(VolumeRawTest, TheHeaderGivesShapeUnitsAxisOrderAndChecksums) {
    write_volume(data(), lattice_volume());
    const Json json = read_header();
    EXPECT_EQ(json["shape"], Json({7, 5, 3}));
    EXPECT_EQ(json["axes"], Json({"x", "y", "z"}));
    EXPECT_EQ(json["units"]["length"], "metre");
    EXPECT_EQ(json["data"], "a.raw");
    EXPECT_THAT(json["axis_order"].get<std::string>(), HasSubstr("the first fastest"));
    const std::string bytes = bytes_of(data());
    EXPECT_EQ(bytes.size(), 105u * (16 + 4 + 4 + 1));
    for (const Json& array : json["arrays"]) {
        const XXH64_hash_t hash =
            XXH3_64bits(bytes.data() + array["offset"].get<size_t>(), array["bytes"]);
        EXPECT_EQ(array["xxh3_64"], fmt::format("{:016x}", hash)) << array["name"];
    }
    const Json matrix = json["world_from_voxels"];
    EXPECT_NEAR(matrix[1][0].get<double>(), turned_observer()[0][1] * 0.5, 1e-15);
    EXPECT_EQ(matrix[3], Json({0.0, 0.0, 0.0, 1.0}));
}

TEST_F(VolumeRawTest, EveryValueIsWhereTheHeaderSays) {
    const Volume volume = single_voxel({7, 5, 3}, {4, 1, 2}, {0.5f, 0.25f, 0.125f}, 0.75f);
    write_volume(data(), volume);
    const std::string bytes = bytes_of(data());
    const size_t index = 4 + 7 * (1 + 5 * 2);
    const auto float_at = [&](size_t offset) {
        float value = 0;
        std::memcpy(&value, bytes.data() + offset, sizeof value);
        return value;
    };
    EXPECT_EQ(float_at(16 * index + 4), 0.25f);
    EXPECT_EQ(float_at(16 * index + 12), 0.75f);
    EXPECT_EQ(float_at(16 * (index + 1)), 0.0f);
    EXPECT_EQ(float_at(105 * 16 + 4 * index), 1.0f);
    EXPECT_EQ(bytes[105 * 20 + 4 * index], 1);
    EXPECT_EQ(bytes[105 * 24 + index], 2);
}

TEST_F(VolumeRawTest, TheSameVolumeGivesTheSameBytes) {
    write_volume(data(), lattice_volume());
    const std::string first = bytes_of(data()), head = bytes_of(header());
    write_volume(data(), lattice_volume());
    EXPECT_TRUE(bytes_of(data()) == first);
    EXPECT_TRUE(bytes_of(header()) == head);
}

TEST_F(VolumeRawTest, DamageIsAnInputError) {
    write_volume(data(), lattice_volume());
    expect_truncations_refused(data(), header(), 97);
    const std::string whole = bytes_of(data());
    put_bytes(data(), whole + "x");
    EXPECT_THAT(error_of([&] { read_volume(header()); }).what(), HasSubstr("more data"));
    put_bytes(data(), whole);
    EXPECT_EQ(count_refused_changes(data(), header(), 200), 200u);
    expect_truncations_refused(header(), header(), 61);
    EXPECT_GT(count_refused_changes(header(), header(), 400), 200u);
}

TEST_F(VolumeRawTest, ALieAboutTheSizeTakesNoMemory) {
    write_volume(data(), lattice_volume());
    Json json = read_header();
    json["voxelume_frame"]["size"] = {65536, 65536, 65536};
    put_bytes(header(), json.dump());
    EXPECT_THAT(error_of([&] { read_volume(header()); }).what(), HasSubstr("doesn't hold"));
}

TEST_F(VolumeRawTest, AnArrayBeginsAtAWholeNumber) {
    write_volume(data(), lattice_volume());
    for (const double offset : {0.5, -1.0, 1e300}) {
        Json json = read_header();
        json["arrays"][1]["offset"] = offset;
        put_bytes(header(), json.dump());
        EXPECT_THAT(error_of([&] { read_volume(header()); }).what(), HasSubstr("no array begins"));
        write_volume(data(), lattice_volume());
    }
}

TEST_F(VolumeRawTest, AHeaderLeadsToNoOtherFolder) {
    write_volume(data(), lattice_volume());
    Json json = read_header();
    for (const char* name : {"../a.raw", "/etc/passwd", "..", ""}) {
        json["data"] = name;
        put_bytes(header(), json.dump());
        EXPECT_THAT(error_of([&] { read_volume(header()); }).what(),
                    HasSubstr("isn't in its folder"))
            << name;
    }
}

TEST_F(VolumeRawTest, AHeaderOfManyLevelsIsNeitherReadNorReplaced) {
    write_volume(data(), lattice_volume());
    std::string deep = bytes_of(header());
    deep.insert(1, "\"zz\":" + std::string(300'000, '[') + std::string(300'000, ']') + ",");
    put_bytes(header(), deep);
    EXPECT_THAT(error_of([&] { read_volume(header()); }).what(),
                HasSubstr("not the header of a volume"));
    EXPECT_EQ(error_of([&] { write_volume(data(), lattice_volume()); }).exit_code(), 5);
    EXPECT_TRUE(bytes_of(header()) == deep);
}

TEST_F(VolumeRawTest, AFullDiskLeavesNothing) {
    expect_full_disk_leaves_nothing(data(), lattice_volume());
}

}  // namespace
}  // namespace voxelume
