// SPDX-License-Identifier: Apache-2.0
// The helper program that decodes images is missing, dies, hangs or lies; and its limits.
#include <gmock/gmock.h>

#include <array>
#include <sstream>

#include "runtime/base/helper/helper_process.hpp"
#include "runtime/base/helper/helper_program.hpp"
#include "runtime/base/sanitizers.hpp"
#include "runtime/base/version.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/image_codec/image_codec.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/writers/png_writer.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ImageDecoderTest : public FileTest {
  protected:
    void TearDown() override {
        decode_images({});
        FileTest::TearDown();
    }
    /// Has a shell's script stand in for the helper, and returns what reading a PNG throws.
    ImageDecoderError failure_of(const std::string& script) const {
        const std::filesystem::path program = folder / "helper";
        put_bytes(program, "#!/bin/sh\n" + script + "\n");
        std::filesystem::permissions(program, std::filesystem::perms::owner_all);
        return failure_with(program);
    }
    ImageDecoderError failure_with(const std::filesystem::path& program) const {
        put_bytes(folder / "a.png", png_of_rows(1, 8, 0, {"1"}));
        decode_images({.is_apart = true, .program = program, .seconds = 0.2});
        try {
            read_png(folder / "a.png");
        } catch (const ImageDecoderError& error) {
            return error;
        }
        ADD_FAILURE() << "a stand-in decodes";
        return {ErrorKind::render, ""};
    }
};

TEST_F(ImageDecoderTest, AHelperThatDiesHangsOrLiesIsOneSentence) {
    const ImageDecoderError died = failure_of("kill -SEGV $$");
    EXPECT_EQ(died.exit_code(), 4);
    EXPECT_THAT(died.what(), HasSubstr("a.png: can't be decoded: its reader ended: Segmentation "
                                       "fault, so it is damaged; use another copy of it"));
    EXPECT_THAT(failure_of("sleep 9").what(),
                HasSubstr("reading it took more than 0.2 s, so it is too large or damaged"));
    EXPECT_THAT(failure_of("echo rubbish >&3; sleep 9").what(),
                HasSubstr("its reader answered what can't be, so it is damaged"));
    EXPECT_THAT(failure_of("printf '\\002GMI\\377\\377\\000\\000\\377\\377\\000\\000' >&3").what(),
                HasSubstr("its reader answered what can't be"));
    EXPECT_THAT(failure_of("exit 2").what(),
                AllOf(HasSubstr("a.png: can't be read: "),
                      HasSubstr("ended with exit code 2; install voxelume again")));
    EXPECT_THAT(failure_with(folder / "gone").what(),
                HasSubstr("gone can't be started: No such file or directory; install voxelume"));
}

TEST_F(ImageDecoderTest, ATextureWhoseHelperFailsIsntLeftOut) {
    put_bytes(folder / "a.png", png_of_rows(1, 8, 0, {"1"}));
    put_bytes(folder / "a.mtl", "newmtl skin\nmap_Kd a.png\n");
    put_bytes(folder / "a.obj",
              "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
              "usemtl skin\nf 1/1 2/2 3/3\n");
    decode_images({.is_apart = true});
    EXPECT_EQ(read_mesh(folder / "a.obj").textures.size(), 1u);
    decode_images({.is_apart = true, .program = folder / "gone"});
    const Error error = error_of([&] { read_mesh(folder / "a.obj"); });
    EXPECT_EQ(error.exit_code(), 4);
    EXPECT_THAT(error.what(), HasSubstr("a.png: can't be read: "));
}

/// A line of a file in /proc of this process's child.
std::string line_of_child(const char* file, const std::string& first_words) {
    std::string child;
    for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task"))
        child += bytes_of(thread.path() / "children");
    std::ifstream stream("/proc/" + child.substr(0, child.find(' ')) + "/" + file);
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with(first_words)) return line.substr(first_words.size());
    return "none";
}

TEST_F(ImageDecoderTest, ItsLimitsHoldWhileItDecodes) {
    // More than fits into the pipe, so that the helper waits behind its limits.
    put_bytes(folder / "a.png", png_of_rows(2000, 8, 0, std::vector(1000, std::string(2000, 'x'))));
    const InputFile file(folder / "a.png");
    HelperProcess helper(helper_program("voxelume-image-decoder"),
                         {version(), "a.png", "png", "10000000"}, file.descriptor(), 60);
    std::array<char, 12> begin{};  // the word and the size
    for (size_t got = 0; got < begin.size();)
        got += helper.read(begin.data() + got, begin.size() - got);
    std::istringstream processor(line_of_child("limits", "Max cpu time"));
    uint64_t seconds = 0, memory = 0, written = 1;
    EXPECT_TRUE(processor >> seconds && seconds == 22);
    std::istringstream(line_of_child("limits", "Max file size")) >> written;
    EXPECT_EQ(written, 0u);
    EXPECT_THAT(line_of_child("status", "NoNewPrivs:"), HasSubstr("1"));
    if (kHasSanitizer) GTEST_SKIP() << "they need more memory and all calls";
    std::istringstream(line_of_child("limits", "Max address space")) >> memory;
    EXPECT_EQ(memory, (1u << 29) + 2 * file.size() + 6 * 4 * 2'000'000);
    EXPECT_THAT(line_of_child("status", "Seccomp:"), HasSubstr("2"));
}

}  // namespace
}  // namespace voxelume
