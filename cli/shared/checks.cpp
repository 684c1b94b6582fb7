// SPDX-License-Identifier: Apache-2.0
#include "cli/shared/checks.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

namespace voxelume::cli {

std::string ending_of(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

std::filesystem::path real_path(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path real = std::filesystem::weakly_canonical(file, error);
    return (error ? std::filesystem::absolute(file) : std::filesystem::absolute(real))
        .lexically_normal();
}

bool is_mesh_name(const std::filesystem::path& file) {
    const std::vector<std::string> endings = mesh_file_endings();
    return std::ranges::count(endings, ending_of(file)) > 0;
}

void check_output(const std::string& path, const std::vector<std::string>& extensions,
                  const char* command) {
    const std::string extension = ending_of(path);
    if (!extensions.empty() && std::ranges::find(extensions, extension) == extensions.end()) {
        fail_usage("{}: {}: the name of an output ends in {}", command, path,
                   fmt::join(extensions, " or "));
    }
    check_output_file(path);
}

void check_voxels_output(const std::string& path, const char* command) {
    std::vector<std::string> endings;
    for (const VoxelFormat& format : voxel_formats()) endings.emplace_back(format.ending);
    check_output(path, endings, command);
}

std::string endings_of_voxels(bool has_surfaces) {
    std::string text;
    for (const VoxelFormat& format : voxel_formats()) {
        if (format.has_surfaces != has_surfaces) continue;
        if (!text.empty()) text += ' ';
        text += format.ending;
    }
    return text;
}

void check_image_output(const std::string& path, const char* command) {
    std::vector<std::string> endings;
    for (const ImageFormat& format : image_formats()) endings.emplace_back(format.ending);
    check_output(path, endings, command);
}

std::vector<std::string> chosen_names(const std::vector<std::string>& texts,
                                      const std::vector<std::string_view>& names,
                                      const char* command, const char* kind) {
    std::vector<std::string> chosen;
    for (const std::string& text : texts) {
        const size_t before = chosen.size();
        std::istringstream stream(text);
        for (std::string name; std::getline(stream, name, ',');) {
            if (name.empty()) continue;
            if (std::ranges::find(names, name) == names.end()) {
                const std::string nearest = suggest(name, names);
                fail_usage(
                    "{}: there is no {} named {}{}", command, kind, quote(name),
                    nearest.empty() ? fmt::format(", only {}", fmt::join(names, ", ")) : nearest);
            }
            chosen.push_back(name);
        }
        if (chosen.size() == before)
            fail_usage("{}: --only {} names no {}; there are {}", command, quote(text), kind,
                       fmt::join(names, ", "));
    }
    return chosen;
}

void check_distinct(const std::vector<std::string>& paths, const char* command) {
    std::map<std::filesystem::path, std::string> known;
    for (const std::string& path : paths) {
        if (path.empty()) continue;
        const auto [first, is_new] =
            known.emplace(std::filesystem::absolute(path).lexically_normal(), path);
        if (!is_new)
            fail_usage("{}: {} and {}: two outputs are one file; give each a name of its own",
                       command, first->second, path);
    }
}

Size parse_size(const std::string& text, const char* command) {
    int width = 0, height = 0;
    char by = 0, rest = 0;
    if (std::sscanf(text.c_str(), "%6d%c%6d%c", &width, &by, &height, &rest) != 3 ||
        std::tolower(static_cast<unsigned char>(by)) != 'x' || width < 1 || height < 1 ||
        width > kMaxImageSide || height > kMaxImageSide)
        fail_usage("{}: --size {}: give WIDTHxHEIGHT, 1 to {} each", command, text, kMaxImageSide);
    return {width, height};
}

std::string one_device(const std::string& selector) {
    if (parts_of_all(selector) == 0) return {};
    return fmt::format("{} names several devices; give one", quote(selector));
}

std::vector<std::string> listed(const std::vector<std::string>& texts) {
    std::vector<std::string> values;
    for (const std::string& text : texts) {
        values.emplace_back();
        for (const char c : text)
            if (c == ',')
                values.emplace_back();
            else
                values.back() += c;
    }
    return values;
}

Check list_of(Check check, const char* example) {
    return [check = std::move(check), example](const std::string& text) -> std::string {
        for (const std::string& value : listed({text})) {
            const std::string fault =
                value.empty() ? quote(text) + " has an empty value next to a comma" : check(value);
            if (!fault.empty()) return fmt::format("{}; give {}", fault, example);
        }
        return {};
    };
}

Check one_of(std::vector<std::string_view> names) {
    return [names = std::move(names)](const std::string& text) -> std::string {
        if (std::ranges::find(names, text) != names.end()) return {};
        return quote(text) + " isn't one";
    };
}

Check in_range(double minimum, double maximum, Number number) {
    return [=](const std::string& text) -> std::string {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        const bool is_whole = text.find_first_not_of("+-0123456789") == std::string::npos;
        const bool is_number =
            !text.empty() && *end == '\0' && value >= minimum && value <= maximum;
        // The parser would read an integer with a leading 0 as octal.
        const size_t first = text.find_first_of("0123456789");
        const bool is_octal =
            is_whole && first != std::string::npos && first + 1 < text.size() && text[first] == '0';
        if (is_number && ((is_whole && !is_octal) || number == Number::any)) return {};
        if (number == Number::whole)
            return fmt::format("{} isn't a whole number from {:.0f} to {:.0f} in digits",
                               quote(text), minimum, maximum);
        return fmt::format("{} isn't a number from {:g} to {:g}", quote(text), minimum, maximum);
    };
}

}  // namespace voxelume::cli
