// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <zlib.h>

#include <cstring>
#include <sstream>

#include "tests/io/volume/volume_damage.hpp"
#include "tests/support/volume_samples.hpp"

namespace voxelume {

using testing::HasSubstr;

namespace {

VolumeOptions nrrd_options(bool all_values, bool compress) {
    VolumeOptions options;
    options.all_values = all_values;
    options.compress = compress;
    return options;
}

/// A strict reader of NRRD with attached headers: one field a line, an empty line, then the data.
struct Nrrd {
    std::map<std::string, std::string> fields, keys;
    std::vector<float> values;

    explicit Nrrd(const std::filesystem::path& path) {
        const std::string bytes = bytes_of(path);
        const size_t end = bytes.find("\n\n");
        std::istringstream lines(bytes.substr(0, end + 1));
        std::string line;
        std::getline(lines, line);
        EXPECT_EQ(line, "NRRD0005");
        while (std::getline(lines, line)) {
            if (line[0] == '#') continue;
            const size_t key = line.find(":="), field = line.find(": ");
            if (key < field)
                keys[line.substr(0, key)] = line.substr(key + 2);
            else
                EXPECT_TRUE(fields.emplace(line.substr(0, field), line.substr(field + 2)).second)
                    << line;
        }
        std::string data = bytes.substr(end + 2);
        if (fields["encoding"] == "gzip") data = gunzip(data);
        values.resize(data.size() / sizeof(float));
        std::memcpy(values.data(), data.data(), data.size());
    }
    static std::string gunzip(const std::string& data) {
        std::string plain(1 << 20, '\0');
        z_stream stream{};
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
        stream.avail_in = uInt(data.size());
        stream.next_out = reinterpret_cast<Bytef*>(plain.data());
        stream.avail_out = uInt(plain.size());
        EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
        EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
        plain.resize(stream.total_out);
        inflateEnd(&stream);
        return plain;
    }
};

std::vector<double> numbers_in(std::string text) {
    for (char& c : text)
        if (c == '(' || c == ')' || c == ',') c = ' ';
    std::istringstream words(text);
    return {std::istream_iterator<double>(words), {}};
}

}  // namespace

class VolumeNrrdTest : public FileTest {
  protected:
    std::filesystem::path path() const { return folder / "a.nrrd"; }
};

TEST_F(VolumeNrrdTest, EveryBitOfAllValuesComesBack) {
    for (const bool compress : {false, true})
        for (const Volume& volume :
             {lattice_volume(), rays_volume(), rays_volume(DisplayShape::ball)}) {
            write_volume(path(), volume, nrrd_options(true, compress));
            expect_same_volume(read_volume(path()), volume);
        }
}

TEST_F(VolumeNrrdTest, ColourAndOpacityAloneComeBackWithMiddlesForDepths) {
    const Volume volume = single_voxel({7, 5, 3}, {4, 1, 2}, {0.5f, 0.25f, 0.125f});
    write_volume(path(), volume);
    const Volume back = read_volume(path());
    EXPECT_EQ(back.indices, volume.indices);
    EXPECT_EQ(back.colors, volume.colors);
    EXPECT_EQ(back.opacities, volume.opacities);
    EXPECT_EQ(back.kinds, volume.kinds);
    // The ball's depths are distances along the ray: |(-1.75 + 0.5 * 4.5, 0.1 + 0.25 * 1.5, 3 + 2 *
    // 2.5)|.
    EXPECT_NEAR(back.depths[0], std::hypot(0.5, 0.475, 8.0), 1e-6);
}

TEST_F(VolumeNrrdTest, ItIsADenseArrayWithUnitsAndDirections) {
    const Volume volume = lattice_volume();
    write_volume(path(), volume, nrrd_options(false, false));
    Nrrd nrrd(path());
    const std::map<std::string, std::string> expected = {{"type", "float"},
                                                         {"dimension", "4"},
                                                         {"sizes", "4 7 5 3"},
                                                         {"space", "3D-right-handed"},
                                                         {"space units", "\"m\" \"m\" \"m\""},
                                                         {"kinds", "RGBA-color space space space"},
                                                         {"centerings", "none cell cell cell"},
                                                         {"endian", "little"}};
    for (const auto& [name, value] : expected) EXPECT_EQ(nrrd.fields[name], value) << name;
    EXPECT_EQ(nrrd.keys["scene"], "room.json");
    EXPECT_EQ(nrrd.keys["note"], "a\\\\b c");

    const glm::dmat4& world = volume.frame.world_from_observer;
    EXPECT_THAT(nrrd.fields["space directions"], testing::StartsWith("none ("));
    const auto directions = numbers_in(nrrd.fields["space directions"].substr(5));
    ASSERT_EQ(directions.size(), 9u);
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(directions[size_t(3 * axis + i)], world[axis][i] * volume.frame.edge[axis],
                        1e-15);
    const auto origin = numbers_in(nrrd.fields["space origin"]);
    const glm::dvec4 first = world * glm::dvec4(-1.75 + 0.25, 0.1 + 0.125, 3 + 1, 1);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(origin[size_t(i)], first[i], 1e-14);
}

TEST_F(VolumeNrrdTest, EveryVoxelIsInItsPlaceAndTheOthersAreZero) {
    const Volume volume = lattice_volume();
    for (const bool compress : {false, true}) {
        write_volume(path(), volume, nrrd_options(false, compress));
        const Nrrd nrrd(path());
        ASSERT_EQ(nrrd.values.size(), 4u * 105u);
        size_t next = 0;
        for (size_t index = 0; index < 105; ++index) {
            const bool listed = next < volume.indices.size() && volume.indices[next] == index;
            EXPECT_EQ(nrrd.values[4 * index + 2], listed ? volume.colors[next].b : 0.0f);
            EXPECT_EQ(nrrd.values[4 * index + 3], listed ? volume.opacities[next] : 0.0f);
            next += listed;
        }
    }
}

TEST_F(VolumeNrrdTest, CurvedRaysSayStepsInsteadOfDirections) {
    write_volume(path(), rays_volume(DisplayShape::sector));
    Nrrd nrrd(path());
    EXPECT_EQ(nrrd.fields.count("space"), 0u);
    EXPECT_EQ(nrrd.fields["spacings"], "NaN NaN NaN 0.3");
    EXPECT_EQ(nrrd.fields["axis mins"], "NaN NaN NaN 0.7");
    EXPECT_EQ(nrrd.fields["labels"], "\"values\" \"u\" \"v\" \"k\"");
}

TEST_F(VolumeNrrdTest, UnuReadsTheSameVoxelsAndTransform) {
    const Volume volume = lattice_volume();
    for (const bool compress : {false, true}) {
        write_volume(path(), volume, nrrd_options(false, compress));
        const ProgramResult head = run_tool(folder, "teem-unu head a.nrrd");
        if (head.exit_code == 127) GTEST_SKIP() << "teem-unu isn't installed";
        EXPECT_EQ(head.exit_code, 0) << head.out;
        const ProgramResult text =
            run_tool(folder, "teem-unu save -f nrrd -e ascii -i a.nrrd -o t.nrrd && cat t.nrrd");
        EXPECT_EQ(text.exit_code, 0) << text.out;
        for (const char* line : {"space directions: none (0.39178578529905", "\"m\" \"m\" \"m\"",
                                 "space origin: (11.740132054"})
            EXPECT_THAT(text.out, HasSubstr(line));
        const auto values = numbers_in(text.out.substr(text.out.find("\n\n") + 2));
        const Nrrd nrrd(path());
        ASSERT_EQ(values.size(), nrrd.values.size());
        for (size_t i = 0; i < values.size(); ++i)
            EXPECT_NEAR(values[i], double(nrrd.values[i]), 1e-6);
    }
    write_volume(path(), rays_volume());
    EXPECT_EQ(run_tool(folder, "teem-unu head a.nrrd").exit_code, 0);
}

TEST_F(VolumeNrrdTest, TheSameVolumeGivesTheSameBytes) {
    write_volume(path(), lattice_volume());
    write_volume(folder / "b.nrrd", lattice_volume());
    EXPECT_TRUE(bytes_of(path()) == bytes_of(folder / "b.nrrd"));
}

TEST_F(VolumeNrrdTest, DamageIsAnInputError) {
    for (const bool compress : {false, true}) {
        write_volume(path(), lattice_volume(), nrrd_options(true, compress));
        expect_truncations_refused(path(), path(), 41);
        count_refused_changes(path(), path(), 300);
    }
    put_bytes(path(), "NRRD0005\ntype: float\ndimension: 1\nsizes: 3\n\nabc");
    EXPECT_THAT(error_of([&] { read_volume(path()); }).what(), HasSubstr("not of a display"));
}

TEST_F(VolumeNrrdTest, ALieAboutTheSizeTakesNoMemory) {
    write_volume(path(), lattice_volume());
    std::string bytes = bytes_of(path());
    const auto replace = [&](const std::string& old, const std::string& by) {
        bytes.replace(bytes.find(old), old.size(), by);
    };
    replace("sizes: 4 7 5 3", "sizes: 4 65536 65536 65536");
    replace("\"size\":[7,5,3]", "\"size\":[65536,65536,65536]");
    put_bytes(path(), bytes);
    EXPECT_THAT(error_of([&] { read_volume(path()); }).what(), HasSubstr("far too small"));
}

TEST_F(VolumeNrrdTest, AFullDiskLeavesNothing) {
    expect_full_disk_leaves_nothing(path(), lattice_volume());
}

}  // namespace voxelume
