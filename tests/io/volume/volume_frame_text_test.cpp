// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/volume/volume_frame_text.hpp"

#include <gmock/gmock.h>

#include "tests/support/file_fixture.hpp"
#include "tests/support/volume_samples.hpp"

namespace voxelume {

using testing::HasSubstr;

TEST(VolumeFrameTextTest, EveryBitComesBack) {
    VolumeFrame frame = rays_volume(DisplayShape::sector).frame;
    frame.step = 0x1.fffffffffffffp-3;
    frame.origin = {1.0 / 3, -1e300, 5e-324};
    expect_same_frame(read_frame_text(write_frame_text(frame), "a"), frame);
    expect_same_frame(read_frame_text(write_frame_text(lattice_volume().frame), "a"),
                      lattice_volume().frame);
}

TEST(VolumeFrameTextTest, WhatIsNoFrameIsAnInputError) {
    const std::string text = write_frame_text(lattice_volume().frame);
    for (size_t length = 0; length < text.size(); ++length)
        EXPECT_EQ(error_of([&] { read_frame_text(text.substr(0, length), "a"); }).exit_code(), 4);
    const auto refusal = [&](const std::string& old, const std::string& by) {
        std::string changed = text;
        changed.replace(changed.find(old), old.size(), by);
        return error_of([&] { read_frame_text(changed, "a.vdb"); });
    };
    for (const auto& [old, by] : std::vector<std::pair<std::string, std::string>>{
             {"\"lattice\"", "\"cube\""},
             {"\"size\":[7,5,3]", "\"size\":[7,5]"},
             {"\"size\":[7,5,3]", "\"size\":[7,0,3]"},
             {"[0.5,0.25,2.0]", "[0.5,-1,2.0]"},
             {"\"edge\"", "\"edges\""},
             {"\"size\":[7,5,3]", "\"size\":[7,5,3e51]"},
             {"\"size\":[7,5,3]", "\"size\":[7,5,3.5]"},
             {"\"size\":[7,5,3]", "\"size\":[7,5,-3]"},
             {"\"size\":[7,5,3]", "\"size\":[7,5,4294967299]"},
             {"10.5", "1e999"}})
        EXPECT_EQ(refusal(old, by).exit_code(), 4) << by;
    EXPECT_THAT(refusal("\"size\":[7,5,3]", "\"size\":[7,5,99999]").what(),
                HasSubstr("a.vdb: it has 99999 voxels along an axis"));
    const std::string deep = std::string(150'000, '[') + std::string(150'000, ']');
    EXPECT_THAT(refusal("\"layout\"", "\"zz\":" + deep + ",\"layout\"").what(),
                HasSubstr("a.vdb: its voxelume_frame is damaged: no JSON of at most 64 levels"));
}

}  // namespace voxelume
