// SPDX-License-Identifier: Apache-2.0
// The container and the buffers of glTF 2.0 (Khronos Group, 2021).
#include "runtime/io/gltf/gltf_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

#include "runtime/base/error.hpp"
#include "runtime/base/json_text.hpp"
#include "runtime/base/text.hpp"
#include "runtime/io/gltf/data_uri.hpp"
#include "runtime/io/mesh/companion_file.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"

namespace voxelume {
namespace {

constexpr size_t kMaxJson = size_t{64} << 20;
constexpr size_t kMaxBuffers = size_t{16} << 30;

/// Extensions that are shown, or that change nothing that is shown.
constexpr std::array<std::string_view, 16> kKnown = {"KHR_lights_punctual",
                                                     "KHR_materials_transmission",
                                                     "KHR_materials_ior",
                                                     "KHR_materials_volume",
                                                     "KHR_materials_emissive_strength",
                                                     "KHR_materials_unlit",
                                                     "KHR_materials_pbrSpecularGlossiness",
                                                     "KHR_texture_transform",
                                                     "KHR_mesh_quantization",
                                                     "EXT_mesh_gpu_instancing",
                                                     "KHR_xmp_json_ld",
                                                     "KHR_materials_specular",
                                                     "KHR_materials_clearcoat",
                                                     "KHR_draco_mesh_compression",
                                                     "EXT_meshopt_compression",
                                                     "KHR_meshopt_compression"};

bool is_known(const std::string& extension) {
    return std::ranges::find(kKnown, extension) != kKnown.end();
}

uint32_t load_word(std::string_view bytes, size_t at) {
    const auto byte = [&](size_t i) { return uint32_t{static_cast<unsigned char>(bytes[at + i])}; };
    return byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
}

/// The chunks of a .glb, or the text of a .gltf.
struct Chunks {
    std::string_view json, binary;
};

/// Throws Error::input, which `name` opens, for a .glb that is damaged.
Chunks chunks_of(std::string_view bytes, const std::string& name) {
    constexpr size_t kHeader = 12, kChunk = 8;
    constexpr uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
    if (!bytes.starts_with("glTF")) return {bytes, {}};
    const auto refuse = [&](const std::string& reason) {
        throw Error(ErrorKind::input, "{}: {}", SourcePlace(name), reason);
    };
    if (bytes.size() < kHeader + kChunk) refuse("the file ends inside the header of a .glb");
    if (load_word(bytes, 4) != 2)
        refuse(fmt::format("version {} of glTF; version 2 is read", load_word(bytes, 4)));
    Chunks chunks;
    size_t at = kHeader;
    for (int number = 0; number < 2 && bytes.size() - at >= kChunk; ++number) {
        const size_t size = load_word(bytes, at);
        const uint32_t type = load_word(bytes, at + 4);
        at += kChunk;
        if (size > bytes.size() - at)
            refuse("the file ends inside a chunk; it is damaged or incomplete");
        if (number == 0 && type != kJson) refuse("its first chunk isn't JSON");
        if (number == 0) chunks.json = bytes.substr(at, size);
        if (number == 1 && type == kBinary) chunks.binary = bytes.substr(at, size);
        at = std::min(at + (size + 3) / 4 * 4, bytes.size());
    }
    return chunks;
}

/// The name of each material, made unique.
std::vector<std::string> names_of_materials(const std::vector<GltfValue>& materials) {
    std::vector<std::string> names;
    names.reserve(materials.size());
    std::set<std::string> taken;
    for (size_t i = 0; i < materials.size(); ++i) {
        std::string name = materials[i].text("name");
        if (name.empty()) name = fmt::format("material {}", i);
        while (!taken.insert(name).second) name += fmt::format(" {}", i);
        names.push_back(std::move(name));
    }
    return names;
}

std::span<const uint8_t> span_of(std::string_view bytes) {
    return {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
}

}  // namespace

bool is_gltf_file(const std::filesystem::path& file) {
    const std::string ending = ending_of(file);
    return ending == ".gltf" || ending == ".glb";
}

GltfFile::GltfFile(std::string bytes, const std::filesystem::path& path)
    : bytes_(std::move(bytes)), path_(path), name_(path.string()) {
    const Chunks chunks = chunks_of(bytes_, name_);
    chunk_ = chunks.binary;
    parse_json(chunks.json);
    check_json();
    material_names_ = names_of_materials(root().items("materials"));
    read_buffers();
    decode_gltf_views(*this, decoded_);
    decode_gltf_primitives(*this, decoded_);
}

uint64_t GltfFile::bytes() const {
    uint64_t sum = bytes_.size();
    for (const std::string& buffer : read_) sum += buffer.size();
    return sum;
}

void GltfFile::parse_json(std::string_view text) {
    if (text.size() > kMaxJson)
        throw Error(ErrorKind::limit, "{}: {} bytes of JSON; at most 64 MiB are read",
                    SourcePlace(name_), text.size());
    bool is_too_deep = false;
    json_ = parse_json_text<nlohmann::json>(text, &is_too_deep);
    if (is_too_deep)
        throw Error(ErrorKind::limit, "{}: its JSON has more than {} levels", SourcePlace(name_),
                    kMaxJsonLevels);
    if (!json_.is_object())
        throw Error(ErrorKind::input, "{}: its JSON can't be read; it is damaged or no glTF",
                    SourcePlace(name_));
}

void GltfFile::check_json() const {
    const std::string version = root().at("asset").text("version");
    if (!version.starts_with("2."))
        root().fail(version.empty()
                        ? "no asset.version, which every glTF file has"
                        : fmt::format("version {} of glTF; version 2 is read", quote(version)));
    for (const GltfValue& name : root().items("extensionsRequired")) {
        if (!name.json().is_string()) name.fail("should be a text");
        const auto extension = name.json().get<std::string>();
        if (!is_known(extension))
            root().fail(fmt::format("needs the extension {}, which isn't read; export it without",
                                    quote(extension)));
    }
}

std::vector<std::string> GltfFile::notes() const {
    std::vector<std::string> notes;
    for (const GltfValue& name : root().items("extensionsUsed"))
        if (name.json().is_string() && !is_known(name.json().get<std::string>()))
            notes.push_back(
                fmt::format("its extension {} isn't shown", quote(name.json().get<std::string>())));
    return notes;
}

std::string GltfFile::bytes_of_uri(const GltfValue& from, const std::string& uri) const {
    if (uri.starts_with("data:")) {
        auto bytes = data_of_uri(uri);
        if (!bytes) from.fail("its data URI isn't base64");
        return std::move(*bytes);
    }
    const auto file = companion_file(path_, name_of_uri(uri));
    if (!file) from.fail(fmt::format("there is no file {} in the folder of the file", quote(uri)));
    return read_mesh_bytes(*file);
}

void GltfFile::read_buffers() {
    const std::vector<GltfValue> all = root().items("buffers");
    read_.reserve(all.size());  // spans of them are kept
    uint64_t sum = 0;
    for (const GltfValue& buffer : all) {
        const uint64_t length = buffer.count("byteLength", 0);
        std::string_view bytes = chunk_;
        if (is_gltf_fallback(buffer)) {
            buffers_.emplace_back();
            continue;
        }
        if (buffer.has("uri")) {
            bytes = read_.emplace_back(bytes_of_uri(buffer, buffer.text("uri")));
        } else if (!buffers_.empty()) {
            bytes = {};  // only the first buffer may be the binary chunk
        }
        sum += bytes.size();
        if (sum > kMaxBuffers) buffer.fail("the buffers have more than 16 GiB");
        if (length > bytes.size())
            buffer.fail(
                fmt::format("has {} bytes, and {} are there; the file is damaged or "
                            "incomplete",
                            length, bytes.size()));
        buffers_.push_back(span_of(bytes.substr(0, length)));
    }
}

std::span<const uint8_t> GltfFile::view(const GltfValue& which, const char* key) const {
    const int number = which.index(key, root().size("bufferViews"));
    if (number < 0) return {};
    const auto decoded = decoded_.views.find(size_t(number));
    if (decoded != decoded_.views.end()) return decoded->second;
    return bytes_in_buffer(root().item("bufferViews", size_t(number)));
}

const std::vector<uint8_t>* GltfFile::decoded_accessor(size_t number) const {
    const auto found = decoded_.accessors.find(number);
    return found == decoded_.accessors.end() ? nullptr : &found->second;
}

std::span<const uint8_t> GltfFile::bytes_in_buffer(const GltfValue& view) const {
    const int buffer = view.index("buffer", buffers_.size());
    if (buffer < 0) view.fail("has no buffer");
    const std::span<const uint8_t> bytes = buffers_[size_t(buffer)];
    const uint64_t offset = view.count("byteOffset", 0), length = view.count("byteLength", 0);
    if (offset > bytes.size() || length > bytes.size() - offset)
        view.fail(
            fmt::format("bytes {} to {} of a buffer of {}", offset, offset + length, bytes.size()));
    return bytes.subspan(offset, length);
}

std::vector<uint8_t> GltfFile::image(const GltfValue& image) const {
    if (image.has("uri")) {
        const std::string bytes = bytes_of_uri(image, image.text("uri"));
        return {bytes.begin(), bytes.end()};
    }
    const std::span<const uint8_t> bytes = view(image, "bufferView");
    return {bytes.begin(), bytes.end()};
}

std::vector<std::filesystem::path> gltf_companions(const std::string& bytes,
                                                   const std::filesystem::path& path) {
    std::vector<std::filesystem::path> files;
    const auto json = parse_json_text<nlohmann::json>(chunks_of(bytes, path.string()).json);
    for (const char* const list : {"buffers", "images"}) {
        if (!json.is_object() || !json.contains(list)) continue;
        for (const nlohmann::json& item : json[list]) {
            if (!item.is_object() || !item.contains("uri") || !item["uri"].is_string()) continue;
            const auto uri = item["uri"].get<std::string>();
            if (uri.starts_with("data:")) continue;
            if (const auto file = companion_file(path, name_of_uri(uri))) files.push_back(*file);
        }
    }
    return files;
}

}  // namespace voxelume
