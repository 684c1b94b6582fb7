// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/frame_list.hpp"

#include <algorithm>
#include <charconv>
#include <regex>
#include <unordered_set>

#include "runtime/base/error.hpp"

namespace voxelume {

namespace {

constexpr size_t kMaxFrames = 1'000'000;

/// The frames `first`, `first + step`, ... up to `last`. They are 64-bit so that a count past the
/// last int ends.
struct FrameRange {
    int64_t first, last, step;
};

int64_t parse_number(const std::string& text, const std::string& part) {
    int value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size())
        throw Error(ErrorKind::usage, "--frames: \"{}\" is beyond the numbers of frames", part);
    return value;
}

FrameRange parse_part(const std::string& part) {
    static const std::regex kPart(R"(\s*(-?[0-9]+)(?:(?:-|\.\.)(-?[0-9]+)(?:x([0-9]+))?)?\s*)");
    std::smatch match;
    if (!std::regex_match(part, match, kPart))
        throw Error(ErrorKind::usage,
                    "--frames: can't read \"{}\"; write a frame or a range, like 1-10,20,30-60x5",
                    part);
    const int64_t first = parse_number(match[1], part);
    const int64_t last = match[2].matched ? parse_number(match[2], part) : first;
    const int64_t step = match[3].matched ? parse_number(match[3], part) : 1;
    if (step == 0) throw Error(ErrorKind::usage, "--frames: the step in \"{}\" is zero", part);
    if (last < first)
        throw Error(ErrorKind::usage, "--frames: \"{}\" ends before it starts; write {}-{}", part,
                    last, first);
    return {first, last, step};
}

}  // namespace

std::vector<int> parse_frame_list(const std::string& text) {
    std::vector<int> frames;
    std::unordered_set<int64_t> seen;
    size_t start = 0;
    while (start <= text.size()) {
        const size_t comma = std::min(text.find(',', start), text.size());
        const FrameRange range = parse_part(text.substr(start, comma - start));
        for (int64_t frame = range.first; frame <= range.last; frame += range.step) {
            if (seen.size() == kMaxFrames)
                throw Error(ErrorKind::usage, "--frames: more than {} frames", kMaxFrames);
            if (seen.insert(frame).second) frames.push_back(static_cast<int>(frame));
        }
        start = comma + 1;
    }
    return frames;
}

}  // namespace voxelume
