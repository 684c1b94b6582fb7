// SPDX-License-Identifier: Apache-2.0
#include "cli/shared/scene_options.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "cli/shared/checks.hpp"
#include "cli/shared/complaint.hpp"
#include "cli/shared/slice_names.hpp"

namespace voxelume::cli {
namespace {

/// Turns "60s" into "60". Other texts stay as they are.
std::string without_unit_of_seconds(std::string text) {
    if (text.size() > 1 && text.back() == 's') text.pop_back();
    return text;
}

}  // namespace

void add_scene_options(CLI::App& app, SceneOptions& options) {
    app.add_option("--assets", options.assets,
                   "folder to look for the scene's models in; may be given again")
        ->allow_extra_args(false);
    app.add_option("--size", options.size,
                   "image size, WIDTHxHEIGHT in pixels; replaces the scene's")
        ->type_name("WIDTHxHEIGHT");
    app.add_option("--samples", options.samples, "samples per pixel; replaces the scene's")
        ->check(in_range(1, 4096, Number::whole));
    app.add_option("--noise", options.noise,
                   "standard error of light at which 4 x 4 pixels, or 16 voxels of a volumetric "
                   "image, have samples enough, of their mean, like 0.02; samples double from 16 "
                   "to at most --samples, which is at least 32 and by default 4096")
        ->check(in_range(1e-4, 1));
    app.add_option("--time", options.time,
                   "seconds that an image's samples may take, which are doubled as long as time "
                   "suffices, or until --noise is reached: 60 or 60s")
        ->type_name("SECONDS")
        ->transform(without_unit_of_seconds)
        ->check(in_range(0.001, 1e6));
    app.add_option(
           "--light", options.light,
           "light of images: local, or global with all that surfaces reflect; replaces the scene's")
        ->type_name("local|global")
        ->check(one_of({"local", "global"}));
    app.add_option(
           "--device", options.device,
           "device: auto, cpu, gpu, a number, part of a name, or all to share frames and tiles")
        ->type_name("DEVICES");
    app.add_option("--device-timeout", options.device_timeout,
                   "seconds after which a device that doesn't answer ends the run")
        ->check(in_range(1, 1e6));
    app.add_option("--memory-limit", options.memory_limit,
                   "limit of main memory, and of the device's own memory: 500MB, 2.5GB")
        ->type_name("SIZE");
    app.add_flag("--no-cache", options.no_cache,
                 "neither read nor write the cache of models and worlds");
    app.add_flag("--strict", options.strict, "take warnings for errors, exit code 3");
    app.add_option("--set", options.settings,
                   "change a value of the scene: PATH=VALUE, like objects.ball.position=0,1,0; may "
                   "be given again")
        ->type_name("PATH=VALUE")
        ->allow_extra_args(false);
    add_import_options(app, options.import);
}

namespace {

void watch_devices(const SceneOptions& options) {
    if (options.device_timeout == 0) return;
    v1::watch_devices(options.device_timeout, [](const std::string& sentence) {
        const int code = complain(sentence, ErrorKind::render);
        remove_unfinished_files();
        std::_Exit(code);
    });
}

void limit_memory(const SceneOptions& options, const char* command) {
    if (options.memory_limit.empty()) return;
    struct Unit {
        std::string_view name;
        double bytes;
    };
    constexpr std::array kUnits = {Unit{"M", 1e6},  Unit{"MB", 1e6}, Unit{"MiB", 1 << 20},
                                   Unit{"G", 1e9},  Unit{"GB", 1e9}, Unit{"GiB", 1 << 30},
                                   Unit{"T", 1e12}, Unit{"TB", 1e12}};
    const std::string& text = options.memory_limit;
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    const auto* unit = std::ranges::find(kUnits, std::string_view(end), &Unit::name);
    if (unit != kUnits.end() && number * unit->bytes >= 1 && number <= 1e6)
        return v1::limit_memory(uint64_t(number * unit->bytes));
    fail_usage("{}: --memory-limit {}: give a size like 500MB or 2.5GB", command, quote(text));
}

}  // namespace

void set_limits(const SceneOptions& options, const char* command) {
    watch_devices(options);
    limit_memory(options, command);
}

SceneChange setting_of(const std::string& text, const char* option, const char* command) {
    bool is_quoted = false;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"') is_quoted = !is_quoted;
        if (text[i] != '=' || is_quoted) continue;
        if (i == 0) break;
        return {text.substr(0, i), text.substr(i + 1),
                fmt::format("{}: {} {}", command, option, text)};
    }
    fail_usage("{}: {} {}: give PATH=VALUE, like objects.ball.position=0,1,0", command, option,
               text);
}

CacheOptions cache_options(const SceneOptions& options) {
    return {.enabled = !options.no_cache};
}

namespace {

v1::SceneOptions files_of(const SceneOptions& options, bool is_model, Size size,
                          const char* command) {
    v1::SceneOptions files{options.assets, cache_options(options), {}, 0};
    if (!is_model) files.orbit = options.orbit;
    for (const std::string& text : options.settings)
        files.changes.push_back(setting_of(text, "--set", command));
    for (const std::string& text : options.swept)
        files.changes.push_back(setting_of(text, "--sweep", command));
    if (options.import.transparent && !is_model)
        files.changes.push_back({"render.transparent", "true", "--transparent"});
    // Views from around are framed for the size that images will have.
    if (options.has_views && size[0] != 0)
        files.changes.push_back({"render.size", fmt::format("{},{}", size[0], size[1]), "--size"});
    return files;
}

/// A model file rotates while its light stays.
ImportOptions import_of(const SceneOptions& options, Size size, const char* command) {
    ImportOptions import = options_of(options.import, size, command);
    import.turns = options.has_views;
    import.orbit = options.orbit;
    return import;
}

}  // namespace

namespace {

/// Standard input as the text of a scene.
std::string read_stdin() {
    constexpr size_t kMaxBytes = size_t{64} << 20;
    std::string text;
    std::array<char, 1 << 16> block{};
    while (const size_t count = std::fread(block.data(), 1, block.size(), stdin)) {
        text.append(block.data(), count);
        if (text.size() > kMaxBytes)
            throw Error(ErrorKind::limit, "stdin: a scene has at most 64 MiB");
    }
    if (std::ferror(stdin) != 0)
        throw Error(ErrorKind::input,
                    fmt::format("stdin: can't be read: {}", std::strerror(errno)));
    return text;
}

}  // namespace

Scene load_scene(const std::string& name, const v1::SceneOptions& options) {
    if (name != "-") return Scene::load(name, options);
    static const std::string text = read_stdin();  // read once, even for several views or values
    return Scene::parse(text, "stdin", options);
}

Scene read_with(const SceneOptions& options, const char* command) {
    const Size size = options.size.empty() ? Size{} : parse_size(options.size, command);
    const std::string input = first_slice(options.scene);
    const bool is_model = is_model_file(input);
    if (!is_model) refuse_choices(options.import, command);
    const v1::SceneOptions files = files_of(options, is_model, size, command);
    Scene scene = is_model ? scene_of_file(input, import_of(options, size, command), files)
                           : load_scene(input, files);
    if (size[0] != 0) scene = scene.with_size(size);
    if (options.noise > 0 || options.time > 0)
        scene = scene.with_noise(options.noise, options.time,
                                 options.samples != 0 ? options.samples : 4096);
    else if (options.samples != 0)
        scene = scene.with_samples(options.samples);
    if (!options.light.empty())
        scene = scene.with_light(options.light == "global" ? LightMode::global : LightMode::local);
    return scene;
}

}  // namespace voxelume::cli
