// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/mesh/material_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "runtime/base/decimal.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/base/text.hpp"
#include "runtime/base/utf8.hpp"
#include "runtime/io/mesh/companion_file.hpp"

namespace voxelume {
namespace {

constexpr size_t kMaxMaterials = 16384, kMaxLibraries = 64;
constexpr uint64_t kMaxBytes = uint64_t{64} << 20;

/// A statement: its words, and where each begins, as names may have spaces in them.
struct Statement {
    std::string line;
    std::vector<size_t> starts;

    explicit Statement(std::string_view text) : line(text) {
        constexpr const char* kBlanks = " \t\r\v\f";
        line.erase(line.find_last_not_of(kBlanks) + 1);
        for (size_t at = line.find_first_not_of(kBlanks); at != std::string::npos;
             at = line.find_first_not_of(kBlanks, line.find_first_of(kBlanks, at)))
            starts.push_back(at);
    }

    size_t words() const { return starts.size(); }
    std::string word(size_t i) const {
        const std::string rest = this->rest(i);
        return rest.substr(0, rest.find_first_of(" \t\r\v\f"));
    }
    /// The rest of the line from word number `i` on.
    std::string rest(size_t i) const { return i < words() ? line.substr(starts[i]) : ""; }
    std::optional<double> number(size_t i) const {
        const std::string text = word(i);
        const Decimal found = scan_decimal(text.c_str());
        const bool is_number = found.status == DecimalStatus::ok && *found.end == '\0';
        return is_number ? std::optional<double>(found.value) : std::nullopt;
    }
};

/// A colour of three numbers, or of one for all channels. Spectral curves and CIE colours are left
/// out.
void read_color(const Statement& statement, glm::dvec3& color) {
    const auto red = statement.number(1);
    if (!red) return;
    const double green = statement.number(2).value_or(*red);
    color = {*red, green, statement.number(3).value_or(green)};
}

void read_number(const Statement& statement, double& value) {
    if (const auto number = statement.number(1)) value = *number;
}

/// The maximum number of values of a texture's option; options of numbers may have fewer.
struct TextureOption {
    std::string_view name;
    size_t values;
};

constexpr std::array<TextureOption, 14> kOptions = {{{"-blendu", 1},
                                                     {"-blendv", 1},
                                                     {"-cc", 1},
                                                     {"-clamp", 1},
                                                     {"-texres", 1},
                                                     {"-mm", 2},
                                                     {"-o", 3},
                                                     {"-s", 3},
                                                     {"-t", 3},
                                                     {"-bm", 1},
                                                     {"-boost", 1},
                                                     {"-imfchan", 1},
                                                     {"-type", 1},
                                                     {"-colorspace", 1}}};

/// The numbers after an option, at most three.
void read_pair(const Statement& statement, size_t option, glm::dvec2& pair) {
    for (int i = 0; i < 2; ++i)
        if (const auto number = statement.number(option + 1 + size_t(i))) pair[i] = *number;
}

MtlTexture texture_of(const Statement& statement) {
    MtlTexture texture;
    size_t at = 1;
    while (at < statement.words()) {
        const std::string word = statement.word(at);
        const auto* const option = std::ranges::find(kOptions, word, &TextureOption::name);
        if (option == kOptions.end()) break;
        if (word == "-clamp") texture.clamps = statement.word(at + 1) == "on";
        if (word == "-o") read_pair(statement, at, texture.offset);
        if (word == "-s") read_pair(statement, at, texture.scale);
        size_t end = at + 1 + option->values;
        if (option->values == 3)
            for (end = at + 1; end < at + 4 && statement.number(end);) ++end;
        at = end;
    }
    texture.file = statement.rest(at);
    return texture;
}

/// The texture to which a statement's word belongs; null for other words.
MtlTexture* map_named(const std::string& word, MtlMaterial& m) {
    if (word == "map_Kd") return &m.diffuse_map;
    if (word == "map_Ke") return &m.emission_map;
    if (word == "map_Pr") return &m.roughness_map;
    if (word == "map_d") return &m.opacity_map;
    return word == "map_Pm" ? &m.metallic_map : nullptr;
}

/// Notes the statements of textures that nothing shows.
void read_unshown(const std::string& word, MtlMaterial& m) {
    constexpr std::array<std::string_view, 7> kBumps = {"map_Bump", "map_bump", "bump",    "norm",
                                                        "map_Kn",   "disp",     "map_disp"};
    m.has_bumps |= std::ranges::find(kBumps, word) != kBumps.end();
    m.has_specular_maps |= word == "map_Ks" || word == "map_Ns";
}

void read_statement(const Statement& statement, MtlMaterial& m) {
    const std::string word = statement.word(0);
    if (word == "Kd") {
        read_color(statement, m.diffuse);
    } else if (word == "Ks") {
        read_color(statement, m.specular);
    } else if (word == "Ke") {
        read_color(statement, m.emission);
    } else if (word == "Ns") {
        read_number(statement, m.exponent);
    } else if (word == "Ni") {
        read_number(statement, m.ior);
    } else if (word == "d") {
        read_number(statement, m.opacity);
    } else if (word == "Tr") {
        double transparency = 1 - m.opacity;
        read_number(statement, transparency);
        m.opacity = 1 - transparency;
    } else if (word == "illum") {
        double model = m.illumination;
        read_number(statement, model);
        m.illumination = model >= 0 && model <= 10 ? int(model) : 2;
    } else if (word == "Pr") {
        m.roughness = statement.number(1);
    } else if (word == "Pm") {
        m.metallic = statement.number(1);
    } else if (MtlTexture* const map = map_named(word, m)) {
        *map = texture_of(statement);
    } else {
        read_unshown(word, m);
    }
}

std::string bytes_of(const InputFile& file) {
    std::string bytes(file.size(), '\0');
    file.read(0, bytes.data(), bytes.size());
    return is_utf16(bytes) ? utf8_of_utf16(bytes) : bytes;
}

/// A library by its name in the mesh's file. Without a file, there is none.
struct NamedLibrary {
    std::string name;
    std::optional<std::filesystem::path> file;
};

std::vector<NamedLibrary> find_libraries(const std::filesystem::path& mesh,
                                         const std::vector<std::string>& names) {
    std::vector<NamedLibrary> found;
    for (const std::string& name : names) {
        auto file = companion_file(mesh, name);
        std::vector<NamedLibrary> several;
        std::istringstream words(name);
        for (std::string word; !file && several.size() < kMaxLibraries && words >> word;)
            several.push_back({word, companion_file(mesh, word)});
        if (std::ranges::any_of(several, [](const NamedLibrary& one) { return !!one.file; }))
            found.insert(found.end(), several.begin(), several.end());
        else
            found.push_back({name, std::move(file)});
    }
    return found;
}

/// A sentence that says which libraries, one or more, are missing. The names are in quotes.
std::string missing_sentence(std::vector<std::string> names) {
    if (names.size() == 1)
        return fmt::format("its material library {} isn't in its folder", names[0]);
    constexpr size_t kMaxNames = 8;
    std::string last = names.back();
    if (names.size() > kMaxNames) last = fmt::format("{} more", names.size() - kMaxNames + 1);
    names.resize(std::min(names.size(), kMaxNames) - 1);
    return fmt::format("its material libraries {} and {} aren't in its folder",
                       fmt::join(names, ", "), last);
}

}  // namespace

std::vector<MtlMaterial> parse_material_library(std::string_view text) {
    std::vector<MtlMaterial> materials;
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        const Statement statement(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (statement.word(0) == "newmtl") {
            if (materials.size() == kMaxMaterials) break;
            materials.emplace_back().name = utf8_text(statement.rest(1));
        } else if (!materials.empty()) {
            read_statement(statement, materials.back());
        }
    }
    return materials;
}

void append_library(const std::string& name, std::vector<std::string>& names) {
    const bool is_new = std::ranges::find(names, name) == names.end();
    if (!name.empty() && is_new && names.size() < kMaxLibraries) names.push_back(name);
}

std::vector<std::filesystem::path> material_library_files(const std::filesystem::path& mesh,
                                                          const std::vector<std::string>& names) {
    std::vector<std::filesystem::path> files;
    for (const NamedLibrary& library : find_libraries(mesh, names))
        if (library.file) files.push_back(*library.file);
    return files;
}

std::vector<MtlMaterial> read_material_libraries(const std::filesystem::path& mesh,
                                                 const std::vector<std::string>& names,
                                                 std::vector<std::string>& faults) {
    std::vector<MtlMaterial> materials;
    std::vector<std::string> missing;
    for (const NamedLibrary& library : find_libraries(mesh, names)) {
        if (!library.file) {
            missing.push_back(quote(library.name));
            continue;
        }
        const InputFile file(*library.file);
        if (file.size() > kMaxBytes) {
            faults.push_back(
                fmt::format("its material library {} isn't read: it has more than 64 MiB",
                            quote(library.name)));
            continue;
        }
        const std::vector<MtlMaterial> more = parse_material_library(bytes_of(file));
        materials.insert(materials.end(), more.begin(), more.end());
    }
    if (!missing.empty()) faults.insert(faults.begin(), missing_sentence(std::move(missing)));
    return materials;
}

}  // namespace voxelume
