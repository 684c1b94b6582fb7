// SPDX-License-Identifier: Apache-2.0
#include "cli/shared/import_options.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <vector>

#include "cli/shared/checks.hpp"

namespace voxelume::cli {
namespace {

struct NamedView {
    std::string_view name;
    double longitude, latitude;
    bool parallel;
};

/// The latitude, in degrees, from which all three axes of a cube look equally long.
constexpr double kIsometric = 35.26438968;

constexpr std::array<NamedView, 7> kViews = {{{"front", 0, 0, false},
                                              {"back", 180, 0, false},
                                              {"side", 90, 0, false},
                                              {"left", -90, 0, false},
                                              {"right", 90, 0, false},
                                              {"top", 0, 90, false},
                                              {"iso", 45, kIsometric, true}}};

std::vector<double> numbers_of(const std::string& text) {
    std::vector<double> numbers;
    for (const std::string& part : listed({text})) {
        if (!in_range(-1e9, 1e9)(part).empty()) return {};
        numbers.push_back(std::strtod(part.c_str(), nullptr));
    }
    return numbers;
}

void set_view(const std::string& text, const char* command, ImportOptions& options) {
    if (text.empty()) return;
    std::vector<std::string_view> names;
    for (const NamedView& view : kViews) {
        names.push_back(view.name);
        if (text != view.name) continue;
        options.longitude = view.longitude;
        options.latitude = view.latitude;
        options.parallel = view.parallel;
        return;
    }
    const std::vector<double> angles = numbers_of(text);
    if (angles.size() == 2 && std::abs(angles[0]) <= 360 && std::abs(angles[1]) <= 90) {
        options.longitude = angles[0];
        options.latitude = angles[1];
        return;
    }
    if (text.find_first_of("0123456789") != std::string::npos)
        fail_usage(
            "{}: --view {}: give LONGITUDE,LATITUDE in degrees, to -360..360 and -90..90, as in "
            "35,25",
            command, text);
    fail_usage("{}: --view: there is no {}{}", command, quote(text), suggest(text, names));
}

double linear_of(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

Color color_of(const std::string& text, const char* command) {
    if (text.size() == 7 && text[0] == '#' &&
        text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos) {
        Color color{};
        for (size_t c = 0; c < 3; ++c)
            color[c] = linear_of(std::stoi(text.substr(1 + 2 * c, 2), nullptr, 16) / 255.0);
        return color;
    }
    const std::vector<double> numbers = numbers_of(text);
    if (numbers.size() == 3 && std::min({numbers[0], numbers[1], numbers[2]}) >= 0)
        return {numbers[0], numbers[1], numbers[2]};
    fail_usage(
        "{}: --background {}: give a colour as \"#rrggbb\", or its linear parts as in 0.2,0.3,0.5",
        command, text);
}

Vec3 spacing_of(const std::string& text, const char* command) {
    std::vector<double> numbers = numbers_of(text);
    if (numbers.size() == 1) numbers.resize(3, numbers[0]);
    if (numbers.size() == 3 && std::min({numbers[0], numbers[1], numbers[2]}) > 0)
        return {numbers[0], numbers[1], numbers[2]};
    fail_usage("{}: --spacing {}: give one number above 0 or three, in metres, as in 0.5,0.5,2",
               command, text);
}

}  // namespace

std::vector<std::string> view_names() {
    std::vector<std::string> names;
    names.reserve(std::size(kViews));
    for (const NamedView& view : kViews) names.emplace_back(view.name);
    return names;
}

std::string model_endings() {
    return fmt::format("{}", fmt::join(model_file_endings(), " "));
}

void add_import_options(CLI::App& app, ImportChoices& choices) {
    app.add_option(
           "--view", choices.view,
           "of a model file: from where: front, back, left, right, side, top, iso (parallel "
           "rays), or LONGITUDE,LATITUDE in degrees; 35,25 by default, -40,30 of a .vox")
        ->type_name("VIEW");
    app.add_option("--fov", choices.angle,
                   "of a model file: horizontal angle of the picture in degrees; 40 by default")
        ->check(in_range(1, 160));
    app.add_option("--background", choices.background,
                   "of a model file: colour of background and ground, \"#rrggbb\", or linear "
                   "R,G,B")
        ->type_name("COLOR");
    app.add_flag_function(
           "--ground,!--no-ground", [&choices](int64_t given) { choices.ground = given > 0; },
           "of a model file: whether it stands on a ground; it does by default unless a .vox has "
           "none, or a glTF file has lights")
        ->check([](const std::string& value) {  // CLI11 fails without a sentence
            return std::string(value == "true" || value == "false" ? "" : "it takes no value");
        });
    app.add_flag("--transparent", choices.transparent,
                 "show nothing where no object is: .png files are transparent there, and a model "
                 "file has no ground by default");
    app.add_option("--fit", choices.fit,
                   "of a model file: length of its longest side in metres; the file's by default")
        ->check(in_range(1e-6, 1e6));
    app.add_option("--up", choices.up,
                   "of a model file: which axis is up, y or z; z by default for .stl alone")
        ->type_name("y|z");
    app.add_option("--spacing", choices.spacing,
                   "of a scan or stack of slices: metres from voxel to voxel, one number or X,Y,Z, "
                   "instead of the file's")
        ->type_name("METRES");
    app.add_option("--clip", choices.clip,
                   "of a glTF file: name of the clip that moves it; its first by default")
        ->type_name("NAME");
}

ImportOptions options_of(const ImportChoices& choices, Size size, const char* command) {
    constexpr std::array kAxes = {std::pair{std::string_view("y"), UpAxis::y},
                                  std::pair{std::string_view("z"), UpAxis::z}};
    ImportOptions options;
    set_view(choices.view, command, options);
    if (choices.angle && options.parallel)
        fail_usage("{}: --fov: the rays of --view iso are parallel; leave one of them out",
                   command);
    options.angle = choices.angle.value_or(options.angle);
    options.own_camera = choices.view.empty() && !choices.angle;
    options.ground = choices.ground;
    if (!choices.background.empty()) options.background = color_of(choices.background, command);
    options.transparent = choices.transparent;
    options.clip = choices.clip;
    if (!choices.spacing.empty()) options.spacing = spacing_of(choices.spacing, command);
    options.fit = choices.fit.value_or(0);
    if (!choices.up.empty())
        options.up = choose(choices.up, kAxes, fmt::format("{}: --up", command).c_str());
    if (size[0] > 0) options.size = size;
    return options;
}

void refuse_choices(const ImportChoices& choices, const char* command) {
    const std::array<std::pair<const char*, bool>, 8> given = {
        {{"--view", !choices.view.empty()},
         {"--fov", choices.angle.has_value()},
         {"--background", !choices.background.empty()},
         {"--ground", choices.ground.has_value()},
         {"--fit", choices.fit.has_value()},
         {"--up", !choices.up.empty()},
         {"--clip", !choices.clip.empty()},
         {"--spacing", !choices.spacing.empty()}}};
    for (const auto& [name, is_given] : given)
        if (is_given)
            fail_usage(
                "{}: {} is for model files: a scene says it itself; `voxelume import` writes the "
                "scene of a model file",
                command, name);
}

}  // namespace voxelume::cli
