// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 file (.gltf, .glb) -> its JSON and the bytes of its buffers.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/io/gltf/gltf_compression.hpp"

namespace voxelume {

/// A part of a glTF file's JSON, with its place for messages: "meshes[3].primitives[0]".
///
/// Members are checked as they are read: each function throws Error::input with the file and the
/// place for a value of another type.
class GltfValue {
  public:
    GltfValue(const std::string& file, const nlohmann::json& json, std::string place)
        : file_(&file), json_(&json), place_(std::move(place)) {}

    const nlohmann::json& json() const { return *json_; }
    const std::string& place() const { return place_; }
    [[noreturn]] void fail(std::string_view sentence) const;

    bool has(const char* key) const;
    /// A member that is an object or list; an empty one where there is none.
    GltfValue at(const char* key) const;
    GltfValue extension(const char* name) const;
    bool has_extension(const char* name) const;
    /// The number of items of a list, which is 0 if it is missing, and one of the items.
    size_t size(const char* key) const;
    GltfValue item(const char* key, size_t number) const;
    /// The items of a list, which may be missing.
    std::vector<GltfValue> items(const char* key) const;

    double number(const char* key, double otherwise) const;
    bool boolean(const char* key, bool otherwise) const;
    std::string text(const char* key, const std::string& otherwise = {}) const;
    /// A list of exactly that many finite numbers; empty where there is none.
    std::vector<double> numbers(const char* key, size_t count) const;
    /// A whole number of at least 0 and at most 2^53.
    uint64_t count(const char* key, uint64_t otherwise) const;
    /// The index of one of `size` things; -1 where there is none.
    int index(const char* key, size_t size) const;

  private:
    const nlohmann::json* find(const char* key) const;
    GltfValue member(const char* key, const nlohmann::json& json) const;

    const std::string* file_;
    const nlohmann::json* json_;
    std::string place_;
};

/// A glTF file in memory. Of its content, only the JSON's syntax is known to be right.
class GltfFile {
  public:
    /// Takes the file's bytes. `path` opens messages; buffers and images lie in its folder. Throws
    /// Error::input for what is no glTF 2.0, for a required extension that isn't known, and for
    /// buffers that are missing or too short, or whose compressed data are damaged; Error::limit
    /// for more than 64 MiB of JSON, 64 levels or 16 GiB of buffers.
    GltfFile(std::string bytes, const std::filesystem::path& path);

    GltfFile(const GltfFile&) = delete;  // views of its bytes are kept
    GltfFile& operator=(const GltfFile&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// The bytes of the file and of those that hold its buffers.
    uint64_t bytes() const;
    GltfValue root() const { return {name_, json_, ""}; }
    /// The bytes of a buffer view, decoded. `which` names it.
    std::span<const uint8_t> view(const GltfValue& which, const char* key) const;
    /// The bytes of a view, or of an extension in its place, in its buffer.
    std::span<const uint8_t> bytes_in_buffer(const GltfValue& view) const;
    /// The elements of an accessor that a Draco primitive fills; null for all others.
    const std::vector<uint8_t>* decoded_accessor(size_t number) const;
    std::span<const uint8_t> buffer(size_t number) const { return buffers_[number]; }
    size_t buffer_count() const { return buffers_.size(); }
    /// The bytes of an image: its file's, a data URI's or a buffer view's.
    std::vector<uint8_t> image(const GltfValue& image) const;
    /// The name of a material, made unique; -1 stands for the material of primitives without one.
    std::string material_name(int material) const {
        return material < 0 ? std::string() : material_names_[size_t(material)];
    }
    const std::vector<std::string>& material_names() const { return material_names_; }
    /// Sentences on extensions that the file uses and that aren't known.
    std::vector<std::string> notes() const;

  private:
    void parse_json(std::string_view text);
    void check_json() const;
    void read_buffers();
    std::string bytes_of_uri(const GltfValue& from, const std::string& uri) const;

    std::string bytes_;
    std::filesystem::path path_;
    std::string name_;
    nlohmann::json json_;
    std::string_view chunk_;         ///< binary chunk of a .glb
    std::vector<std::string> read_;  ///< buffers that were read from other files
    std::vector<std::span<const uint8_t>> buffers_;
    std::vector<std::string> material_names_;
    GltfDecoded decoded_;
};

/// True for names that end in .gltf or .glb.
bool is_gltf_file(const std::filesystem::path& file);

/// The files of a glTF file's buffers and images. Throws Error::input for a .glb whose chunks are
/// damaged.
std::vector<std::filesystem::path> gltf_companions(const std::string& bytes,
                                                   const std::filesystem::path& path);

}  // namespace voxelume
