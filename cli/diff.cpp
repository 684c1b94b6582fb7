// voxelume diff A B: how far two images are from each other.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "cli/commands.hpp"
#include "cli/report.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/input_file.hpp"
#include "runtime/image/flip.hpp"
#include "runtime/image/image_difference.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/mesh/mesh_color.hpp"
#include "runtime/scene_file/scene_fields.hpp"

namespace voxelume::cli {

namespace {

constexpr const char* kColors[] = {"R", "G", "B"};

struct DiffOptions {
    std::string a, b;
    std::string channels;  ///< names with commas between them; empty: all
    std::optional<double> fail;
    bool json = false;
};

bool is_png(const std::string& path) {
    const InputFile file(path);
    char start[4] = {};
    file.read(0, start, std::min<uint64_t>(sizeof start, file.size()));
    return std::string_view(start, sizeof start) == "\x89PNG";
}

/// A picture's codes as parts of 255: what is compared is what is seen.
Image image_from(const Picture& picture) {
    Image image{picture.width, picture.height, {}, {}, {}};
    constexpr const char* kNames[] = {"R", "G", "B", "A"};
    for (size_t channel = 0; channel < 4; ++channel) {
        std::vector<float> values;
        values.reserve(picture.pixels.size());
        for (const auto& pixel : picture.pixels)
            values.push_back(static_cast<float>(pixel[channel]) / 255.0f);
        image.planes[kNames[channel]] = std::move(values);
    }
    return image;
}

Image read_image(const std::string& path) {
    return is_png(path) ? image_from(read_png(path)) : read_exr(path);
}

/// Codes as the light that they stand for.
void make_linear(Image& image) {
    for (const char* name : kColors)
        for (float& value : image.planes.at(name)) value = linear_from_srgb(double(value));
}

bool has_colors(const Image& image) {
    const auto is_nan = [](float value) { return std::isnan(value); };
    return std::ranges::all_of(kColors, [&](const char* name) {
        const auto plane = image.planes.find(name);
        return plane != image.planes.end() && std::ranges::none_of(plane->second, is_nan);
    });
}

/// Nothing without colours, and for colours that aren't numbers.
std::optional<double> flip_of(Image a, Image b, bool are_codes) {
    if (!has_colors(a) || !has_colors(b)) return {};
    if (are_codes) make_linear(a), make_linear(b);
    return mean_flip(a, b);
}

struct FileDifference {
    ImageDifference errors;
    std::optional<double> flip;
};

FileDifference compare_files(const DiffOptions& options) {
    if (is_png(options.a) != is_png(options.b))
        throw Error(ErrorKind::usage,
                    "diff: {} and {} aren't of one kind: a PNG holds codes, an EXR light",
                    options.a, options.b);
    const Image a = read_image(options.a), b = read_image(options.b);
    if (a.width != b.width || a.height != b.height)
        throw Error(ErrorKind::render, "{} has {} x {} pixels and {} has {} x {}", options.a,
                    a.width, a.height, options.b, b.width, b.height);
    return {compare_images(a, b), flip_of(a, b, is_png(options.a))};
}

/// Leaves the channels that were asked for, and FLIP where all colours are among them.
void select_channels(FileDifference& compared, const std::string& list) {
    ImageDifference& difference = compared.errors;
    std::vector<std::string_view> known(difference.only_in_a.begin(), difference.only_in_a.end());
    known.insert(known.end(), difference.only_in_b.begin(), difference.only_in_b.end());
    for (const ChannelDifference& channel : difference.channels) known.push_back(channel.channel);
    std::vector<std::string> wanted;
    std::istringstream stream(list);
    for (std::string name; std::getline(stream, name, ',');) {
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw Error(ErrorKind::usage, "diff: no channel named {}{}", quote(name),
                        suggest(name, known));
        wanted.push_back(name);
    }
    const auto unwanted = [&](const std::string& name) {
        return std::find(wanted.begin(), wanted.end(), name) == wanted.end();
    };
    std::erase_if(difference.channels, [&](const auto& c) { return unwanted(c.channel); });
    std::erase_if(difference.only_in_a, unwanted);
    std::erase_if(difference.only_in_b, unwanted);
    if (std::ranges::any_of(kColors, unwanted)) compared.flip.reset();
}

Report make_report(const FileDifference& compared) {
    const ImageDifference& difference = compared.errors;
    Report report;
    report["channels"] = Report::array();
    for (const ChannelDifference& c : difference.channels)
        report["channels"].push_back({{"channel", c.channel},
                                      {"max", c.largest},
                                      {"rmse", c.rmse},
                                      {"mae", c.mae},
                                      {"mrse", c.mrse},
                                      {"differing", c.differing},
                                      {"unmatched", c.unmatched}});
    if (compared.flip) report["FLIP"] = *compared.flip;
    if (!difference.only_in_a.empty()) report["only in A"] = difference.only_in_a;
    if (!difference.only_in_b.empty()) report["only in B"] = difference.only_in_b;
    return report;
}

void check_limit(const ImageDifference& difference, double limit) {
    const auto fail = [](const std::string& reason) {
        throw Error(ErrorKind::render, "the images differ: {}", reason);
    };
    for (const ChannelDifference& c : difference.channels) {
        if (c.unmatched > 0)
            fail(fmt::format("{} pixels of {} are finite in one only", c.unmatched, c.channel));
        if (c.rmse > limit)
            fail(fmt::format("the RMSE of {} is {:.6g}, above {:.6g}", c.channel, c.rmse, limit));
    }
    if (!difference.only_in_a.empty()) fail("only A has channel " + difference.only_in_a.front());
    if (!difference.only_in_b.empty()) fail("only B has channel " + difference.only_in_b.front());
}

}  // namespace

Action add_diff(CLI::App& app) {
    auto options = std::make_shared<DiffOptions>();
    app.add_option("A", options->a, "the image to judge, OpenEXR or PNG")->required();
    app.add_option("B", options->b, "the reference, of the same kind and size")->required();
    app.add_option("--channels", options->channels, "compare these only, like R,G,B");
    app.add_option("--fail", options->fail,
                   "exit with 1 when a channel's RMSE is above this, when a value is finite in one "
                   "image only, or when a channel is missing; ids only inform");
    app.add_flag("--json", options->json, "print JSON");
    app.footer(
        "max, rmse, mae: largest, root mean square and mean absolute error; mrse: mean of\n"
        "((A - B) / (|B| + 0.01))^2; differing: pixels that aren't equal; unmatched: those of "
        "them\n"
        "that aren't finite in both, which the errors leave out. FLIP: mean of what eyes see when\n"
        "the images alternate, 0..1 (Andersson et al. 2020, LDR: light is cut to 0..1), at 67\n"
        "pixels a degree.");
    return [options] {
        FileDifference difference = compare_files(*options);
        if (!options->channels.empty()) select_channels(difference, options->channels);
        print_report(make_report(difference), options->json);
        if (options->fail) check_limit(difference.errors, *options->fail);
        return 0;
    };
}

}  // namespace voxelume::cli
