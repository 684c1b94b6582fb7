// SPDX-License-Identifier: Apache-2.0
// Reads a mesh file into memory and passes it to the reader of its format.
#include "runtime/io/mesh/mesh_reader.hpp"

#include "runtime/base/files/input_file.hpp"
#include "runtime/base/huge_pages.hpp"
#include "runtime/geometry/mesh_normals.hpp"
#include "runtime/io/mesh/mesh_source.hpp"
#include "runtime/io/mesh/mesh_textures.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <system_error>

namespace voxelume {
namespace {

namespace fs = std::filesystem;

/// A limit above the size of the largest allowed mesh as binary PLY (13 bytes a triangle). A larger
/// file could only exhaust the memory.
constexpr uint64_t kMaxFileBytes = uint64_t{16} << 30;

std::string read_bytes(const fs::path& path) {
    const std::string name = path.string();
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) {
        throw Error(ErrorKind::input, "{}: no such mesh file", SourcePlace(name));
    }
    if (error) {
        throw Error(ErrorKind::input, "{}: can't be read: {}", SourcePlace(name), error.message());
    }
    if (!fs::is_regular_file(status)) {
        throw Error(ErrorKind::input, "{}: {}, not a mesh file", SourcePlace(name),
                    fs::is_directory(status) ? "a directory" : "a device or pipe");
    }
    const InputFile file(path);
    const uint64_t size = file.size();
    if (size > kMaxFileBytes) {
        throw Error(ErrorKind::limit, "{}: {} bytes, and a mesh file has at most {} here; split it",
                    name, size, kMaxFileBytes);
    }
    std::string bytes;
    bytes.reserve(size);
    advise_huge_pages(bytes.data(), bytes.capacity());
    bytes.resize(size);
    file.read(0, bytes.data(), size);
    return bytes;
}

std::string lower_extension(const fs::path& name) {
    std::string extension = name.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return extension;
}

/// Drops normals if all of them have length 0, so that `auto` and shading follow the faces.
void leave_out_normals_of_no_use(Mesh& mesh) {
    const auto has_direction = [](const glm::vec3& n) {
        return unit_or_zero(glm::dvec3(n)) != glm::dvec3(0);
    };
    if (std::ranges::any_of(mesh.normals, has_direction)) return;
    mesh.normals = {};
    mesh.triangle_normals = {};
}

/// One format. A new format is a row of kFormats and the functions of the row, which lie in a file
/// of their own.
struct MeshFormat {
    const char* extension;                         ///< extension of file names, in lower case
    bool (*looks_like)(const std::string& bytes);  ///< null where the content has no mark
    Mesh (*parse)(const MeshSource& source);
};

constexpr std::array<MeshFormat, 3> kFormats = {{
    {".ply", looks_like_ply, parse_ply},
    {".stl", looks_like_stl, parse_stl},
    {".obj", nullptr, parse_obj},
}};

/// The format that the content has, or else the one that the name stands for; null if neither is
/// known.
const MeshFormat* format_of(const std::string& bytes, const std::string& extension) {
    for (const MeshFormat& format : kFormats)
        if (format.looks_like && format.looks_like(bytes)) return &format;
    for (const MeshFormat& format : kFormats)
        if (extension == format.extension) return &format;
    return nullptr;
}

}  // namespace

Mesh parse_mesh(const std::string& bytes, const fs::path& name) {
    const MeshSource source{bytes, name.string()};
    const std::string extension = lower_extension(name);
    if (bytes.empty()) {
        source.fail("the file is empty");
    }
    try {
        if (const MeshFormat* format = format_of(bytes, extension)) {
            Mesh mesh = format->parse(source);
            leave_out_normals_of_no_use(mesh);
            read_textures(name, mesh);
            return mesh;
        }
    } catch (const std::bad_alloc&) {
        throw Error(ErrorKind::limit, "{}: not enough memory to read this mesh of {} bytes",
                    SourcePlace(source.name), bytes.size());
    }
    source.fail(
        "neither name nor content is that of a mesh; .obj, .ply, .stl, .gltf and .glb are "
        "read, and `convert` turns files of voxels into others");
}

std::string read_mesh_bytes(const fs::path& path) {
    try {
        return read_bytes(path);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorKind::limit, "{}: not enough memory to read this mesh",
                    SourcePlace(path.string()));
    }
}

Mesh read_mesh(const fs::path& path) {
    return parse_mesh(read_mesh_bytes(path), path);
}

}  // namespace voxelume
