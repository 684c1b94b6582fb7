// SPDX-License-Identifier: Apache-2.0
// The alpha of textures where rays meet exact triangles, as in glTF files and libraries of OBJ
// files: the view through sheets that stand one behind another, and the light that falls through
// them.
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/io/image/png.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/instance_scenes.hpp"
#include "tests/support/writers/gltf_writer.hpp"
#include "tests/support/writers/png_writer.hpp"

namespace voxelume {
namespace {

constexpr int kTexels = 8;

/// The alpha of a texel, from 0 to 1: a slope, up to the right and down.
double texel_alpha(int x, int y) {
    return std::round(255 * std::clamp(0.02 + 0.1 * x + 0.05 * y, 0.0, 1.0)) / 255;
}

/// The bilinear alpha at a place of the sheet, which ends beyond its edges.
double alpha_at(double u, double v) {
    const double x = u * kTexels - 0.5, y = v * kTexels - 0.5;
    const auto texel = [](double at) { return std::clamp(int(at), 0, kTexels - 1); };
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
        const double cx = std::floor(x) + (i & 1), cy = std::floor(y) + (i >> 1);
        sum += (1 - std::abs(x - cx)) * (1 - std::abs(y - cy)) * texel_alpha(texel(cx), texel(cy));
    }
    return sum;
}

/// The alpha between vertices at the corners of the sheet, which is linear.
double vertex_alpha(double u, double v) {
    return 0.1 + 0.6 * u + 0.2 * v;
}

/// The coverage at a point of a sheet with this alpha mode.
double covered(const std::string& mode, double u, double v) {
    const double alpha = alpha_at(u, v);
    return mode == "BLEND" ? alpha : mode == "MASK" ? double(alpha >= 0.4) : 1.0;
}

class TextureAlpha : public FileTest {
  protected:
    /// Sheets from -1 to 1 across and up at z = 0 and at z = 0.5, there 0.3 further to the side, of
    /// a grey texture.
    void write(const std::string& mode, float grey) const {
        GltfWriter writer;
        std::vector<float> positions, uvs;
        std::vector<uint16_t> corners;
        for (const float z : {0.0f, 0.5f}) {
            const float x = z == 0 ? 0.0f : 0.3f;
            for (const unsigned corner : {0u, 1u, 2u, 0u, 2u, 3u})
                corners.push_back(uint16_t(positions.size() / 3 + corner));
            positions.insert(positions.end(),
                             {x - 1, -1, z, x - 1, 1, z, x + 1, 1, z, x + 1, -1, z});
            uvs.insert(uvs.end(), {0, 1, 0, 0, 1, 0, 1, 1});
        }
        const int p = writer.accessor(positions, "VEC3", 3), t = writer.accessor(uvs, "VEC2", 2);
        const int i = writer.accessor(corners, "SCALAR", 1);
        Image image{kTexels, kTexels, {}, {}, {}};
        std::vector<float> alpha, color;
        for (int k = 0; k < kTexels * kTexels; ++k) {
            alpha.push_back(float(texel_alpha(k % kTexels, k / kTexels)));
            color.push_back(grey * alpha.back());
        }
        for (const char* channel : {"R", "G", "B"}) image.planes[channel] = color;
        image.planes["A"] = alpha;
        writer.json["images"] = {
            {{"uri", "data:image/png;base64," +
                         GltfWriter::base64(png_bytes(image, {.keep_alpha = true}))}}};
        writer.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33071}}};
        writer.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
        writer.json["materials"] = {
            {{"alphaMode", mode},
             {"alphaCutoff", 0.4},
             {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
        writer.show(p, t, i);
        put_bytes(folder / "sheets.gltf", writer.gltf());
    }

    /// Writes the sheets as an OBJ file, whose library has the alpha in map_Kd, or grey in map_d.
    void write_obj(bool by_map_d, uint8_t grey) const {
        const std::string options = " -clamp on ";
        std::vector<std::string> colors(kTexels), shares(kTexels);
        for (int k = 0; k < kTexels * kTexels; ++k) {
            const int x = k % kTexels, y = k / kTexels;
            const auto alpha = char(std::lround(255 * texel_alpha(x, y)));
            colors[size_t(y)] += std::string(3, char(grey)) + alpha;
            shares[size_t(y)] += alpha;
        }
        put_bytes(folder / "colors.png", png_of_rows(kTexels, 8, 6, colors));
        put_bytes(folder / "shares.png", png_of_rows(kTexels, 8, 0, shares));
        put_bytes(folder / "a.mtl", "newmtl a\nmap_Kd" + options + "colors.png\n");
        if (by_map_d) {
            const std::string code = std::to_string(grey / 255.0);
            put_bytes(folder / "a.mtl",
                      "newmtl a\nKd " + code + "\nmap_d" + options + "shares.png\n");
        }
        put_bytes(folder / "sheets.obj",
                  "mtllib a.mtl\nv -1 -1 0\nv -1 1 0\nv 1 1 0\nv 1 -1 0\nv -0.7 -1 0.5\n"
                  "v -0.7 1 0.5\nv 1.3 1 0.5\nv 1.3 -1 0.5\nvt 0 0\nvt 0 1\nvt 1 1\nvt 1 0\n"
                  "usemtl a\nf 1/1 2/2 3/3 4/4\nf 5/1 6/2 7/3 8/4\n");
    }

    /// Writes the same sheets without a texture. Their vertices have the alpha of `vertex_alpha`.
    void write_vertices(const std::string& mode) const {
        GltfWriter writer;
        std::vector<float> positions, colors;
        for (const float z : {0.0f, 0.5f})
            for (const auto& [u, v] : {std::pair(0, 1), {0, 0}, {1, 0}, {1, 1}}) {
                const float x = float(2 * u - 1) + (z == 0 ? 0.0f : 0.3f);
                positions.insert(positions.end(), {x, float(1 - 2 * v), z});
                colors.insert(colors.end(), {0.5f, 0.5f, 0.5f, float(vertex_alpha(u, v))});
            }
        const int p = writer.accessor(positions, "VEC3", 3);
        const int c = writer.accessor(colors, "VEC4", 4);
        const int i =
            writer.accessor(std::vector<uint16_t>{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}, "SCALAR", 1);
        writer.json["materials"] = {{{"alphaMode", mode}, {"alphaCutoff", 0.4}}};
        writer.show(p, -1, i);
        nlohmann::json& primitive = writer.json["meshes"][0]["primitives"][0];
        primitive["attributes"].erase("TEXCOORD_0");
        primitive["attributes"]["COLOR_0"] = c;
        put_bytes(folder / "sheets.gltf", writer.gltf());
    }

    Scene scene_of(const char* placement, double eye, const char* light,
                   const char* mesh = "sheets.gltf") const {
        return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.05, "bounds": {{"min": [-2, -2, -0.3], "max": [2, 2, 1.6]}}, {}}},
"materials": {{"sheet": {{"color": [1, 1, 1]}}, "wall": {{"color": [0.25, 0.5, 1]}}}},
"models": {{"sheets": {{"mesh": "{}", "surface": "exact", "voxel_size": 0.05}},
           "wall": {{"shape": "box", "size": [3.8, 3.8, 0.2], "surface": "exact"}}}},
"objects": [{{"model": "sheets", "material": "sheet", "placement": "{}"}},
            {{"model": "wall", "material": "wall", "position": [0, 0, 1.4]}}],
"observer": {{"position": [0, 0, {}], "look_at": [0, 0, 9],
             "display": {{"shape": "box", "size": [2.8, 2.4, 6]}}}},
"lights": [], "render": {{"size": [56, 48]}}}})",
                                       light, mesh, placement, eye),
                           folder / "scene.json", {});
    }
};

/// The root of the mean square of the differences of red light from what `expected` tells for the
/// place of each pixel, in 1/255.
template <class Expected>
double difference(const Image& image, const Expected& expected) {
    double squares = 0;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            double sum = 0;
            for (int i = 0; i < 64; ++i) {
                const int part_x = i % 8, part_y = i / 8;
                // The observer looks along Z, so X runs to the left.
                const double x = 1.4 - 2.8 * (column + (part_x + 0.5) / 8) / image.width;
                const double y = 1.2 - 2.4 * (row + (part_y + 0.5) / 8) / image.height;
                sum += expected(x, y) / 64;
            }
            const size_t pixel = size_t(row) * size_t(image.width) + size_t(column);
            const double off = image.planes.at("R")[pixel] - sum;
            squares += off * off;
        }
    return 255 * std::sqrt(squares / (image.width * image.height));
}

/// The coverage at a point of the sheet whose middle is at `middle`.
double sheet_at(const std::string& mode, double x, double y, double middle) {
    const double u = (x - middle + 1) / 2, v = (1 - y) / 2;
    return std::abs(x - middle) > 1 || std::abs(y) > 1 ? 0 : covered(mode, u, v);
}

TEST_F(TextureAlpha, ShowsWhatLiesBehindSheetsOfOneObject) {
    for (const char* mode : {"OPAQUE", "MASK", "BLEND"}) {
        write(mode, 0.5f);
        for (const char* placement : {"world", "instance"}) {
            const Scene scene = scene_of(placement, -3, R"("ambient": [1, 1, 1])");
            const double off = difference(image_of_scene(scene), [&](double x, double y) {
                const double front = sheet_at(mode, x, y, 0), next = sheet_at(mode, x, y, 0.3);
                return front * 0.5 + (1 - front) * (next * 0.5 + (1 - next) * 0.25);
            });
            EXPECT_LT(off, 6) << mode << placement;
        }
    }
}

TEST_F(TextureAlpha, OfLibrariesIsThatOfBlends) {
    // sRGB 188 is 0.5028 in linear light. map_d alone leaves the color to the scene's material.
    const char* const ambient = R"("ambient": [1, 1, 1])";
    for (const bool by_map_d : {false, true}) {
        write_obj(by_map_d, 188);
        const double own = by_map_d ? 1 : 0.5028;
        const Scene scene = scene_of("world", -3, ambient, "sheets.obj");
        const double off = difference(image_of_scene(scene), [&](double x, double y) {
            const double front = sheet_at("BLEND", x, y, 0), next = sheet_at("BLEND", x, y, 0.3);
            return front * own + (1 - front) * (next * own + (1 - next) * 0.25);
        });
        EXPECT_LT(off, 6) << by_map_d;
    }
}

TEST_F(TextureAlpha, OfVerticesIsLinearBetweenThem) {
    const auto covered_at = [](const std::string& mode, double x, double y, double middle) {
        if (std::abs(x - middle) > 1 || std::abs(y) > 1) return 0.0;
        const double alpha = vertex_alpha((x - middle + 1) / 2, (1 - y) / 2);
        return mode == "BLEND" ? alpha : double(alpha >= 0.4);
    };
    for (const std::string mode : {"MASK", "BLEND"}) {
        write_vertices(mode);
        const Scene scene = scene_of("world", -3, R"("ambient": [1, 1, 1])");
        const double off = difference(image_of_scene(scene), [&](double x, double y) {
            const double front = covered_at(mode, x, y, 0), next = covered_at(mode, x, y, 0.3);
            return front * 0.5 + (1 - front) * (next * 0.5 + (1 - next) * 0.25);
        });
        EXPECT_LT(off, 6) << mode;
    }
}

TEST_F(TextureAlpha, LetsLightThrough) {
    for (const char* mode : {"OPAQUE", "MASK", "BLEND"}) {
        write(mode, 1.0f);
        for (const char* placement : {"world", "instance"}) {
            Scene scene = scene_of(placement, 0.8, R"("ambient": [0, 0, 0])");
            Light light;
            light.kind = LightKind::directional;
            light.direction = {0, 0, 1};
            light.intensity = glm::vec3(1);
            scene.lights = {light};
            const double off = difference(image_of_scene(scene), [&](double x, double y) {
                return 0.25 * (1 - sheet_at(mode, x, y, 0)) * (1 - sheet_at(mode, x, y, 0.3));
            });
            EXPECT_LT(off, 6) << mode << placement;
        }
    }
}

}  // namespace
}  // namespace voxelume
