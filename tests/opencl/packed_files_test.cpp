// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/source/packed_files.hpp"

#include <gtest/gtest.h>

#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using PackedFiles = FileTest;

TEST_F(PackedFiles, ComeBackWithTheirNamesAndBytes) {
    std::filesystem::create_directories(folder / "AB" / "scale" / "1-1-1-goffs0");
    const std::filesystem::path names[] = {"AB/program.bc", "AB/scale/1-1-1-goffs0/scale.so"};
    put_bytes(folder / names[0], std::string("5 x\n\0y", 6));
    put_bytes(folder / names[1], "");
    const std::string bytes = packed(folder, names);
    const auto files = packed_files(bytes);
    ASSERT_EQ(files.size(), 2u);
    EXPECT_EQ(files[0].first, names[0]);
    EXPECT_EQ(files[0].second, std::string_view("5 x\n\0y", 6));
    EXPECT_EQ(files[1].first, names[1]);
    EXPECT_EQ(files[1].second, "");
}

TEST_F(PackedFiles, OfNamesThatLeadElsewhereAreRefused) {
    for (const char* name : {"/tmp/a.so", "../a.so", "AB/../../a.so", "AB/..", "..", "", "AB//a.so",
                             "./a.so", "AB/.hidden.so", "AB/a.sh", "AB/program.bc.sh", "a b.so",
                             "a\\b.so", "\x01.so", "a/a/a/a/a/a/a/a/a.so", "AB/"}) {
        const std::string bytes = std::string("1 AB/a.so\nx1 ") + name + "\nx";
        EXPECT_THROW(packed_files(bytes), PackedFileError) << name;
    }
    EXPECT_THROW(packed_files("1 " + std::string(2000, 'a') + ".so\nx"), PackedFileError);
}

TEST_F(PackedFiles, ThatAreCutOffAreRefused) {
    const std::string whole = "3 AB/a.so\nxyz2 AB/b.so\nuv";
    EXPECT_EQ(packed_files(whole).size(), 2u);
    for (size_t size = 1; size < whole.size(); ++size)
        if (size != 13) {
            EXPECT_THROW(packed_files(whole.substr(0, size)), PackedFileError) << size;
        }
    for (const char* bytes : {"-1 AB/a.so\nxyz", "99999999999999999999 AB/a.so\n", " AB/a.so\n",
                              "18446744073709551615 AB/a.so\nxyz"})
        EXPECT_THROW(packed_files(bytes), PackedFileError) << bytes;
}

}  // namespace
}  // namespace voxelume
