// SPDX-License-Identifier: Apache-2.0
// Model files in place of scenes: what the made scene shows, from where, and how it names files.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/api/api_fixture.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume::v1 {
namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;
using testing::Not;

/// A box of 7 x 5 x 3 with a corner cut off, far from the origin.
constexpr const char* kBlock =
    "v 10 20 30\nv 17 20 30\nv 17 25 30\nv 10 25 30\nv 10 20 33\nv 17 20 33\nv 17 25 33\n"
    "f 1 3 2\nf 1 4 3\nf 5 6 7\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 4 1 5\nf 3 4 7\nf 4 5 7\n";

class ApiImport : public ApiTest {
  protected:
    void SetUp() override {
        ApiTest::SetUp();
        std::ofstream(folder / "block.obj") << kBlock;
    }

    Image picture(const ImportOptions& options) const {
        // One sample a pixel, so that no pixel mixes objects.
        const Scene scene =
            scene_of_file(folder / "block.obj", options, {.cache = no_cache}).with_samples(1);
        return render_image(scene, *device, 1, {.cache = no_cache});
    }

    const CacheOptions no_cache{.enabled = false};
};

/// The columns and rows that an object takes: first and last of each.
struct Taken {
    int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};

Taken pixels_of(const Image& image, uint32_t object) {
    Taken taken;
    const auto ids = image.object_ids();
    const int width = image.width();
    for (size_t i = 0; i < ids.size(); ++i) {
        if (ids[i] != object) continue;
        const int x = int(i) % width, y = int(i) / width;
        taken = {std::min(taken.left, x), std::max(taken.right, x), std::min(taken.top, y),
                 std::max(taken.bottom, y)};
    }
    return taken;
}

TEST_F(ApiImport, AMeshFillsThePictureFromEverySideWithoutBeingCut) {
    size_t turn = 0;
    for (const auto& [longitude, latitude] : {std::pair{35.0, 25.0},
                                              {0.0, 0.0},
                                              {90.0, 0.0},
                                              {-140.0, 60.0},
                                              {0.0, 90.0},
                                              {20.0, -35.0}})
        for (const bool parallel : {false, true})
            for (const Size size : in_turn<Size>({{96, 72}, {72, 96}, {128, 48}}, turn++)) {
                SCOPED_TRACE(testing::Message() << longitude << " " << latitude << " " << parallel
                                                << " " << size[0] << "x" << size[1]);
                const Image image = picture({.longitude = longitude,
                                             .latitude = latitude,
                                             .parallel = parallel,
                                             .size = size});
                const Taken taken = pixels_of(image, 1);
                EXPECT_GT(taken.left, 0);
                EXPECT_GT(taken.top, 0);
                EXPECT_LT(taken.right, size[0] - 1);
                EXPECT_LT(taken.bottom, size[1] - 1);
                const double across = double(taken.right - taken.left + 1) / size[0];
                const double down = double(taken.bottom - taken.top + 1) / size[1];
                EXPECT_GT(std::max(across, down), 0.7);
            }
}

TEST_F(ApiImport, NamedSidesAreThoseOfTheFile) {
    const auto sides = [&](double longitude, double latitude) {
        const Taken taken = pixels_of(picture({.longitude = longitude,
                                               .latitude = latitude,
                                               .parallel = true,
                                               .size = {200, 200}}),
                                      1);
        return double(taken.right - taken.left + 1) / (taken.bottom - taken.top + 1);
    };
    EXPECT_NEAR(sides(0, 0), 7.0 / 5, 0.03);
    EXPECT_NEAR(sides(90, 0), 3.0 / 5, 0.03);
    EXPECT_NEAR(sides(0, 90), 7.0 / 3, 0.05);
    // The corner that is missing is at the top left of the front.
    const Image front =
        picture({.longitude = 0, .latitude = 0, .parallel = true, .size = {200, 200}});
    const Taken taken = pixels_of(front, 1);
    const auto at = [&](int x, int y) {
        return front.object_ids()[size_t(y) * size_t(front.width()) + size_t(x)];
    };
    const auto normal = [&](int x, int y) {
        return front.plane("N.Z")[size_t(y) * size_t(front.width()) + size_t(x)];
    };
    EXPECT_EQ(at(taken.left + 5, taken.top + 5), 1u);
    EXPECT_LT(normal(taken.left + 5, taken.top + 5), 0.9f);
    EXPECT_GT(normal(taken.right - 5, taken.bottom - 5), 0.99f);
}

TEST_F(ApiImport, TheGroundWithoutShadowHasTheRadianceOfTheBackground) {
    for (const std::optional<Color> background :
         {std::optional<Color>{}, std::optional<Color>{Color{0.1, 0.4, 0.6}}}) {
        const Image image = picture({.background = background, .size = {160, 120}});
        const auto ids = image.object_ids();
        const size_t corner = 0;  // top left
        ASSERT_EQ(ids[corner], 0u);
        const auto level = [](float linear) { return 255 * std::pow(linear, 1 / 2.4f); };
        for (const char* channel : {"R", "G", "B"}) {
            const auto plane = image.plane(channel);
            float brightest = 0, at_edge = 0;  // on the ground; the mean where it ends
            int edges = 0;
            for (size_t i = 160; i < ids.size(); ++i) {
                if (ids[i] != 2) continue;
                brightest = std::max(brightest, plane[i]);
                if (ids[i - 160] != 0) continue;
                at_edge += plane[i];
                ++edges;
            }
            at_edge /= float(edges);
            EXPECT_NEAR(level(brightest), level(plane[corner]), 0.6) << channel;
            EXPECT_NEAR(level(at_edge), level(plane[corner]), 1.5) << channel;
        }
        if (background) {
            EXPECT_NEAR(image.plane("G")[corner], 0.4f, 1e-3);
        }
        // Some of the ground lies in shadow.
        float darkest = 1;
        for (size_t i = 0; i < ids.size(); ++i)
            if (ids[i] == 2) darkest = std::min(darkest, image.plane("G")[i]);
        EXPECT_LT(darkest, 0.7f * image.plane("G")[corner]);
    }
}

TEST_F(ApiImport, AGroundIsThereOnRequestAndForObserversAboveIt) {
    const auto has_ground = [&](const ImportOptions& options) {
        return import_file(folder / "block.obj", folder, options).find("\"ground\":") !=
               std::string::npos;
    };
    EXPECT_TRUE(has_ground({}));
    EXPECT_FALSE(has_ground({.ground = false}));
    EXPECT_FALSE(has_ground({.latitude = -10}));
}

TEST_F(ApiImport, TheTextIsTheSceneThatIsShown) {
    const ImportOptions options{.fit = 2, .size = {40, 30}};
    const std::string text = import_file(folder / "block.obj", folder, options);
    EXPECT_THAT(text, HasSubstr("\"fit\": 2"));
    const Scene parsed = Scene::parse(text, folder / "scene.json");
    const Image a = render_image(parsed.with_samples(1), *device, 1, {.cache = no_cache});
    const Image b = picture(options);
    for (const std::string& name : a.channels())
        EXPECT_TRUE(std::ranges::equal(a.plane(name), b.plane(name))) << name;
    EXPECT_EQ(parsed.size(), (Size{40, 30}));
    EXPECT_EQ(parsed.object_names(), (std::vector<std::string>{"block", "ground"}));
    EXPECT_EQ(parsed.fitted().find("observer"), std::string::npos);
}

TEST_F(ApiImport, FilesAreNamedAsSeenFromTheScenesFolder) {
    fs::create_directory(folder / "parts");
    fs::rename(folder / "block.obj", folder / "parts" / "my \"block\".obj");
    const fs::path file = folder / "parts" / "my \"block\".obj";
    EXPECT_THAT(import_file(file, folder), HasSubstr(R"("mesh": "parts/my \"block\".obj")"));
    EXPECT_THAT(import_file(file, folder / "elsewhere"),
                HasSubstr(R"("mesh": "my \"block\".obj")"));
    fs::create_symlink(file, folder / "link.obj");
    const Scene scene = scene_of_file(folder / "link.obj", {}, {.cache = no_cache});
    EXPECT_EQ(scene.object_names().front(), "my \"block\"");
}

TEST_F(ApiImport, StlFilesStandOnTheirLowestZ) {
    std::ofstream(folder / "a.stl") << "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 4\n"
                                       "vertex 2 0 4\nvertex 0 3 9\nendloop\nendfacet\nendsolid\n";
    EXPECT_THAT(import_file(folder / "a.stl", folder), HasSubstr("\"turn\": [0, -90, 0]"));
    EXPECT_THAT(import_file(folder / "a.stl", folder, {.up = UpAxis::y}), Not(HasSubstr("turn")));
    EXPECT_THAT(import_file(folder / "block.obj", folder, {.up = UpAxis::z}), HasSubstr("turn"));
    const Scene scene = scene_of_file(folder / "a.stl", {}, {.cache = no_cache});
    EXPECT_THAT(scene.fitted(), HasSubstr("bounds"));
}

TEST_F(ApiImport, WhatCantBeShownIsRefusedWithASentence) {
    const auto message = [&](const fs::path& file) -> std::string {
        try {
            (void)import_file(file, folder);
        } catch (const Error& error) {
            return error.what();
        }
        return "nothing was refused";
    };
    EXPECT_THAT(message(folder / "none.obj"), HasSubstr("no such file"));
    EXPECT_THAT(message(folder / "scene.json"), HasSubstr("isn't the name of a model file"));
    std::ofstream(folder / "point.obj") << "v 1 2 3\nf 1 1 1\n";
    EXPECT_THAT(message(folder / "point.obj"), HasSubstr("one point"));
    std::ofstream(folder / "text.obj") << "hello\n";
    EXPECT_THAT(message(folder / "text.obj"), HasSubstr("text.obj"));
    std::ofstream(folder / "short.vxm") << "\x89VXM";
    EXPECT_THAT(message(folder / "short.vxm"), HasSubstr("short.vxm"));
}

TEST_F(ApiImport, MessagesNameTheFileAndItsPartsButNoLineThatNobodyWrote) {
    const auto message = [&](const std::string& path, const std::string& value) -> std::string {
        try {
            (void)scene_of_file(folder / "block.obj", {},
                                {.cache = no_cache, .changes = {{path, value, ""}}});
        } catch (const Error& error) {
            return error.what();
        }
        return "nothing was refused";
    };
    EXPECT_THAT(message("objects.block.material", "oak"),
                HasSubstr("objects.block.material: no material named \"oak\""));
    const Scene open =
        scene_of_file(folder / "block.obj", {},
                      {.cache = no_cache, .changes = {{"models.block.surface", "smooth", ""}}});
    for (const Warning& warning :
         plan(open, (*device)[0], {.channels = {}, .cache = no_cache}).warnings)
        EXPECT_THAT(warning.where,
                    testing::MatchesRegex(".*/block\\.obj: (objects|models)\\.block"));
}

TEST_F(ApiImport, MapsOfAMeshWithoutPlacesForThemChangeNoMaterial) {
    put_bytes(folder / "a.mtl", "newmtl m\nKd 0.5 0.5 0.5\nmap_Ke a.png\nmap_Pm a.png\n");
    put_bytes(folder / "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
    const std::string text = import_file(folder / "a.obj", folder, {});
    EXPECT_THAT(text, Not(HasSubstr("emission")));
    EXPECT_THAT(text, Not(HasSubstr("\"metallic\": 1")));
}

TEST_F(ApiImport, TheGroupsOfAnObjFileHaveTheMaterialsOfItsLibrary) {
    std::ofstream(folder / "room.mtl")
        << "newmtl oak\nKd 0.5 0 1\nKs 1 1 1\nNs 60\nnewmtl pane\nd 0.25\nillum 6\nNi 1.5\n"
           "newmtl lamp\nKe 1 0.5 0\nnewmtl mist\nTr 0.5\nnewmtl unused\n";
    std::string text = "mtllib room.mtl\n" + std::string(kBlock);
    const char* const groups[] = {"oak", "pane", "lamp", "mist", "nothing", "room"};
    for (const char* const group : groups) text += "usemtl " + std::string(group) + "\nf 1 2 3\n";
    std::ofstream(folder / "room.obj") << text;
    const std::string scene = import_file(folder / "room.obj", folder, {}, no_cache);
    EXPECT_THAT(scene, HasSubstr("\"oak\": {\"color\": [0.214, 0, 1], \"specular\": 1, "
                                 "\"shininess\": 60}"));
    EXPECT_THAT(scene, HasSubstr("\"diffuse\": 0.25, \"reflection\": 1, \"refraction\": 0.75, "
                                 "\"ior\": 1.5, \"fresnel\": true}"));
    EXPECT_THAT(scene, HasSubstr("\"emission\": [1, 0.214, 0]"));
    EXPECT_THAT(scene, HasSubstr("\"opacity\": 0.5"));
    EXPECT_THAT(scene, HasSubstr("\"material\": \"default\",\n     \"materials\": {\"oak\": "
                                 "\"oak\","))
        << "the library lacks two materials, and a warning asks for them";
    EXPECT_THAT(scene, HasSubstr("\"shadow\": \"filtered\""));
    EXPECT_THAT(scene, Not(HasSubstr("unused")));
    EXPECT_THAT(scene, Not(HasSubstr("nothing")));
    EXPECT_NO_THROW(scene_of_file(folder / "room.obj"));
    std::ofstream(folder / "room.mtl", std::ios::app) << "newmtl nothing\nnewmtl room\n";
    EXPECT_THAT(import_file(folder / "room.obj", folder, {}, no_cache),
                HasSubstr("\"material\": \"room\",\n     \"materials\": {\"oak\":"))
        << "the faces before the first group have none";
}

/// The process of these tests may start no other.
TEST_F(ApiImport, CompressedMeshesAreRefusedWhereNoProgramMayDecodeThem) {
    std::ofstream(folder / "compressed.gltf") << R"({"asset": {"version": "2.0"},
"extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"],
"buffers": [{"byteLength": 4, "uri": "data:application/octet-stream;base64,RFJBQw=="}],
"bufferViews": [{"buffer": 0, "byteLength": 4}],
"accessors": [{"componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
              {"componentType": 5125, "count": 3, "type": "SCALAR"}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "extensions":
    {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}],
"nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0})";
    try {
        scene_of_file(folder / "compressed.gltf", {}, {.cache = no_cache});
        FAIL() << "decoded by whom?";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_THAT(error.what(), HasSubstr("isolate_readers"));
    }
}

}  // namespace
}  // namespace voxelume::v1
