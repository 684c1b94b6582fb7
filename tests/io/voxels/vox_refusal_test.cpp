// SPDX-License-Identifier: Apache-2.0
// MagicaVoxel files that are damaged, truncated or beyond the limits end in a sentence.
#include <gmock/gmock.h>

#include <random>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/io/voxels/vox_voxels.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/writers/vox_writer.hpp"

namespace voxelume {

using testing::HasSubstr;

class VoxRefusal : public FileTest {
  protected:
    std::string message_of(const std::string& bytes) const {
        put_bytes(folder / "a.vox", bytes);
        const Error error = error_of([&] { read_voxel_model(folder / "a.vox", Surface::cubes); });
        EXPECT_EQ(error.kind(), ErrorKind::input);
        return error.what();
    }

    static VoxWriter with_model() {
        VoxWriter writer;
        writer.model({2, 3, 4}, {{0, 0, 0, 1}, {1, 2, 3, 2}});
        return writer;
    }
};

TEST_F(VoxRefusal, NamesWhatIsWrong) {
    EXPECT_THAT(message_of(with_model().bytes(151)), HasSubstr("version 151"));
    EXPECT_THAT(message_of("VOX "), HasSubstr("too short"));
    EXPECT_THAT(message_of(VoxWriter().bytes()), HasSubstr("no voxels to show"));
    VoxWriter writer;
    writer.model({300, 1, 1}, {});
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("300 x 1 x 1 voxels; at most 256"));
    writer = {};
    writer.model({2, -1, 1}, {});
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("2 x -1 x 1"));
    writer = {};
    writer.model({2, 2, 2}, {{0, 2, 0, 1}});
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("outside of its model"));
    writer = {};
    writer.chunk("XYZI", VoxWriter::number(0));
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("voxels and no size"));
    writer = {};
    writer.chunk("SIZE", VoxWriter::number(1) + VoxWriter::number(1) + VoxWriter::number(1));
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("no voxels; the file is truncated"));
    writer = {};
    writer.chunk("SIZE", VoxWriter::number(1) + VoxWriter::number(1) + VoxWriter::number(1));
    writer.chunk("XYZI", VoxWriter::number(1000000));
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("counts more voxels than it holds"));
    writer = with_model();
    writer.chunk("RGBA", "short");
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("fewer than 256 colours"));
}

TEST_F(VoxRefusal, NamesWhatIsWrongWithTheSceneGraph) {
    VoxWriter writer = with_model();
    writer.transform(0, 1, -1, {}, {{}});
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("a node 1 that there isn't"));
    writer = with_model();
    writer.transform(0, 1, -1, {}, {{}});
    writer.group(1, {0});
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("circle"));
    writer = with_model();
    writer.shape(0, {{1, {}}});
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("names model 2 of 1"));
    for (const char* byte : {"0", "5", "3", "12"}) {
        writer = with_model();
        writer.transform(0, 1, -1, {}, {{{"_r", byte}}});
        EXPECT_THAT(message_of(writer.bytes()), HasSubstr("a rotation")) << byte;
    }
    writer = with_model();
    writer.transform(0, 1, -1, {}, {{{"_t", "1 2"}}});
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("three whole numbers"));
    writer = with_model();
    writer.transform(0, 1, -1, {}, {{{"_t", "2000000 0 0"}}});
    writer.shape(1, {{0, {}}});
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("farther than 1000000 voxels"));
    // Twenty groups that each show the next one twice are a million objects.
    writer = with_model();
    for (int i = 0; i < 20; ++i) writer.group(i, {i + 1, i + 1});
    writer.shape(20, {{0, {}}});
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("more than 50000 objects"));
    writer = with_model();
    writer.group(0, {1, 2});
    writer.transform(1, 3, 0, {}, {{{"_t", "0 0 0"}}});
    writer.transform(2, 3, 0, {}, {{{"_t", "900000 0 0"}}});
    writer.shape(3, {{0, {}}});
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("at most 65536 along each axis"));
}

TEST_F(VoxRefusal, SmallFilesDontSpanIndicesOfGigabytes) {
    VoxWriter writer = with_model();
    writer.group(0, {1, 2});
    writer.transform(1, 3, 0, {}, {{{"_t", "0 0 0"}}});
    writer.transform(2, 3, 0, {}, {{{"_t", "6000 6000 6000"}}});
    writer.shape(3, {{0, {}}});
    EXPECT_THAT(message_of(writer.bytes()), HasSubstr("bricks of 16 are possible in a file of"));
}

TEST_F(VoxRefusal, ATruncatedFileIsRefusedWhereverItEnds) {
    VoxWriter writer = with_model();
    writer.transform(0, 1, -1, {{"_name", "box"}}, {{{"_t", "1 2 3"}}});
    writer.shape(1, {{0, {}}});
    const std::string bytes = writer.bytes();
    for (size_t size = 0; size < bytes.size(); ++size) {
        put_bytes(folder / "a.vox", bytes.substr(0, size));
        try {
            // A file cut between two chunks is another whole file.
            EXPECT_FALSE(read_voxel_model(folder / "a.vox", Surface::cubes).slots.empty());
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input) << size << ": " << error.what();
        }
    }
}

TEST_F(VoxRefusal, DamagedFilesEndInModelsOrSentences) {
    VoxWriter writer = with_model();
    writer.transform(0, 1, -1, {{"_name", "box"}}, {{{"_r", "17"}, {"_t", "1 2 3"}}});
    writer.group(1, {2, 3});
    writer.shape(2, {{0, {}}});
    writer.shape(3, {{0, {{"_f", "2"}}}});
    writer.layer(0, {{"_hidden", "0"}});
    writer.material(2, {{"_type", "_glass"}, {"_ior", "0.3"}});
    const std::string whole = writer.bytes();
    std::mt19937 random(42);
    int refused = 0;
    for (int round = 0; round < 400; ++round) {
        std::string bytes = whole;
        for (int i = 0; i < 1 + round % 3; ++i) bytes[random() % bytes.size()] = char(random());
        put_bytes(folder / "a.vox", bytes);
        try {
            read_voxel_model(folder / "a.vox", Surface::cubes);
        } catch (const Error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
}

}  // namespace voxelume
