// SPDX-License-Identifier: Apache-2.0
// The fields in headers of NRRD files, and the assumptions where they are missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/io/arrays/array_files.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class NrrdWords : public FileTest {
  protected:
    std::filesystem::path put(const std::string& bytes) const {
        put_bytes(folder / "a.nhdr", bytes);
        return folder / "a.nhdr";
    }
};

TEST_F(NrrdWords, DataInSeveralFilesAreRefusedWhetherListedOrNumbered) {
    const std::string head =
        "NRRD0005\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nendian: little\n";
    for (const char* files : {"data file: LIST\na.raw\nb.raw\n", "data file: LIST 2\na.raw\nb.raw",
                              "datafile: LIST\r\na.raw\r\n", "data file: a%03d.raw 1 2 1\n"}) {
        const Error error = error_of([&] { read_nrrd_header(put(head + files)); });
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_THAT(error.what(), HasSubstr("its data are in several files; join them to one"));
    }
}

TEST_F(NrrdWords, OfAnAxisThatIsNoColourAreAssumedToBeOne) {
    const std::string head =
        "NRRD0005\ntype: float\ndimension: 4\nsizes: 3 2 2 1\nencoding: raw\nendian: little\n"
        "space: 3D-right-handed\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n";
    const auto notes = [&](const std::string& kinds) {
        const auto file = put(head + kinds + "\n" + std::string(3 * 4 * 4, '\0'));
        std::filesystem::rename(file, folder / "a.nrrd");
        return read_nrrd_header(folder / "a.nrrd").notes;
    };
    const auto assumed = Contains(HasSubstr("assumed: the 3 values of a cell are a colour"));
    EXPECT_THAT(notes("kinds: vector domain domain domain\n"), assumed);
    EXPECT_THAT(notes(""), assumed);
    EXPECT_THAT(notes("kinds: RGB-color domain domain domain\n"), Not(assumed));
    EXPECT_THAT(notes("kinds: 3-color space space space\n"), Not(assumed));
}

}  // namespace
}  // namespace voxelume
