// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/exr_chunk_spool.hpp"

#include <gmock/gmock.h>

#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

class ExrChunkSpoolTest : public FileTest {
  protected:
    std::filesystem::path spooled() const {
        return std::filesystem::directory_iterator(folder)->path();
    }
};

TEST_F(ExrChunkSpoolTest, GivesChunksPartAfterPart) {
    ExrChunkSpool spool(folder / "a.exr");
    spool.put(2, 0, "two");
    spool.put(1, 0, "one");
    spool.put(1, 16, "more");
    std::string all;
    spool.take_out([&](size_t part, int row, const std::string& bytes) {
        all += std::to_string(part) + "," + std::to_string(row) + "," + bytes + " ";
    });
    EXPECT_EQ(all, "1,0,one 1,16,more 2,0,two ");
}

TEST_F(ExrChunkSpoolTest, RefusesAChunkThatHasChanged) {
    ExrChunkSpool spool(folder / "a.exr");
    spool.put(1, 0, "rows of a part");
    put_bytes(spooled(), "rows of a cart");
    const Error error = error_of([&] { spool.take_out([](size_t, int, const std::string&) {}); });
    EXPECT_EQ(error.exit_code(), 5);
    EXPECT_THAT(error.what(), testing::HasSubstr("a.exr: can't be written: rows that waited"));
}

}  // namespace
}  // namespace voxelume
