// SPDX-License-Identifier: Apache-2.0
#include "cli/files/diff_images.hpp"

#include <algorithm>
#include <utility>

#include "cli/shared/checks.hpp"

namespace voxelume::cli {
namespace {

/// Throws where images lack what is compared.
void check_channels(const Image& a, const Image& b, const DiffFiles& files,
                    const ImageDifference& difference, const DiffLimits& limits) {
    if (difference.channels.empty())
        throw Error(ErrorKind::render,
                    fmt::format("{} and {} have no channel in common", files.a, files.b));
    if (!limits.flip) return;
    for (const char* color : {"R", "G", "B"})
        for (const auto& [image, name] : {std::pair(&a, &files.a), std::pair(&b, &files.b)})
            if (!image->has(color))
                fail_usage("diff: FLIP compares colours, and {} has no {}", *name, color);
}

}  // namespace

void check_colors(const DiffLimits& limits, const std::vector<std::string>& channels) {
    if (!limits.flip || channels.empty()) return;
    for (const char* color : {"R", "G", "B"})
        if (std::ranges::find(channels, color) == channels.end())
            fail_usage("diff: FLIP compares colours, and --channels leaves {} out", color);
}

ImageDifference compare_files(const DiffFiles& files, const CompareOptions& options,
                              const DiffLimits& limits) {
    const Image a = Image::read(files.a), b = Image::read(files.b);
    if (a.holds_codes() != b.holds_codes())
        fail_usage("diff: {} and {} aren't of one kind: a PNG holds codes, an EXR light", files.a,
                   files.b);
    if (a.width() != b.width() || a.height() != b.height())
        throw Error(ErrorKind::render,
                    fmt::format("{} has {} x {} pixels and {} has {} x {}", files.a, a.width(),
                                a.height(), files.b, b.width(), b.height()));
    ImageDifference difference = compare(a, b, options);
    check_channels(a, b, files, difference, limits);
    ImageFileOptions whole{.float_color = true};
    for (const ChannelRow& row : channel_table()) whole.channels.*row.member = true;
    if (!files.output.empty()) difference_image(a, b, options).write(files.output, whole);
    if (!files.flip.empty() && difference.flip) flip_image(a, b).write(files.flip, whole);
    return difference;
}

}  // namespace voxelume::cli
