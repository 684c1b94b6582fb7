// SPDX-License-Identifier: Apache-2.0
// Warnings about meshes: their unit, holes, faces and materials. Each mesh is read only once.
#include "runtime/analysis/warnings/mesh_warnings.hpp"

#include <fmt/format.h>

#include "runtime/import/scene_of_file.hpp"
#include "runtime/io/image/png.hpp"
#include "tests/analysis/warned_scene.hpp"
#include "tests/support/writers/gltf_writer.hpp"

namespace voxelume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Kind = WarningKind;
using MeshWarnings = WarnedScene;

}  // namespace

TEST_F(MeshWarnings, NameAMeshInMillimetresAndNothingElseOfIt) {
    show_mesh("part.obj", ball({0, 0, 0}, 150, 32, 16));
    EXPECT_THAT(kinds(), ElementsAre(Kind::unlikely_unit));
    EXPECT_THAT(warnings()[0].text,
                HasSubstr("300 m large in a world of 2 m, so its unit is probably wrong: "
                          "coordinates are metres; if the file is in millimetres, give its model "
                          "\"unit\": \"mm\""));
    json["objects"].erase(1);
    json["lights"][0]["position"] = {0, 500, 0};
    EXPECT_THAT(kinds(), ElementsAre(Kind::unlikely_unit)) << "though it holds the observer";
    json["models"]["ball"]["unit"] = "mm";
    EXPECT_THAT(kinds(), IsEmpty());
    json["models"]["ball"]["unit"] = "km";
    EXPECT_THAT(kinds(), ElementsAre(Kind::unlikely_unit));
    EXPECT_THAT(warnings()[0].text, HasSubstr("change its model's \"unit\""));
}

TEST_F(MeshWarnings, NameTheUnitThatMakesAMeshTooSmall) {
    show_mesh("part.obj", ball({0, 0, 0}, 0.3, 32, 16));
    json["models"]["ball"]["unit"] = "mm";
    ASSERT_THAT(kinds(), testing::Contains(Kind::unlikely_unit));
    EXPECT_THAT(warnings()[0].text,
                HasSubstr("so its unit is probably wrong: its model's \"unit\" takes the file's "
                          "coordinate 1 for 0.001 m; if it is 1 m, leave \"unit\" out"));
}

TEST_F(MeshWarnings, NameAMeshInMetresInAWorldOfMillimetres) {
    show_mesh("part.obj", ball({0, 0, 0}, 0.3, 32, 16));
    json["world"] = {{"voxel_size", 10},
                     {"bounds", {{"min", {-500, -500, -500}}, {"max", {500, 500, 500}}}}};
    json["objects"].erase(1);
    EXPECT_THAT(kinds(), ElementsAre(Kind::unlikely_unit));
    EXPECT_THAT(warnings()[0].text, HasSubstr("a \"scale\" 1000 times as large"));
    json["objects"][0]["placement"] = "instance";
    EXPECT_THAT(kinds(), ElementsAre(Kind::unlikely_unit));
    json["objects"][0]["scale"] = 2;  // an instance may be a small thing
    EXPECT_THAT(kinds(), testing::Not(testing::Contains(Kind::unlikely_unit)));
    json["objects"][0]["placement"] = "world";
    EXPECT_THAT(kinds(), ElementsAre(Kind::unlikely_unit));
}

TEST_F(MeshWarnings, NameAnOpenMeshWhereAnInsideIsNeeded) {
    show_mesh("bowl.obj", open_ball(0.3));
    EXPECT_THAT(kinds(), ElementsAre(Kind::open_mesh));
    EXPECT_THAT(warnings()[0].where.text(), HasSubstr("models.ball"));
    EXPECT_THAT(warnings()[0].text, HasSubstr("\"bowl.obj\" is open along 32 edges"));
    json["models"]["ball"]["surface"] = "exact";
    EXPECT_THAT(kinds(), IsEmpty());
    json["objects"][0]["material"] = "glass";
    EXPECT_THAT(kinds(), ElementsAre(Kind::open_mesh));
}

TEST_F(MeshWarnings, NameAMeshThatIsInsideOut) {
    show_mesh("ball.obj", turned(ball({0, 0, 0}, 0.3, 32, 16)));
    EXPECT_THAT(kinds(), ElementsAre(Kind::inside_out_mesh));
    json["models"]["ball"]["surface"] = "exact";
    EXPECT_THAT(kinds(), IsEmpty());
}

TEST_F(MeshWarnings, SayOfAModelOnceWhatTwoObjectsShow) {
    show_mesh("ball.obj", turned(ball({0, 0, 0}, 0.3, 32, 16)));
    json["objects"].push_back({{"model", "ball"}, {"material", "red"}, {"position", {0.5, 0, 0}}});
    EXPECT_THAT(kinds(), ElementsAre(Kind::inside_out_mesh));
}

TEST_F(MeshWarnings, NameMaterialsThatAreNotRead) {
    const std::string faces = "v 0 0 0\nv .5 0 0\nv 0 .5 0\nv 0 0 .5\nusemtl a\nf 1 3 2\nf 1 2 4\n";
    put_bytes(folder / "m.obj", "mtllib my lib.mtl\n" + faces + "usemtl b\nf 2 3 4\nf 3 1 4\n");
    json["models"]["ball"] = {{"mesh", "m.obj"}, {"surface", "exact"}};
    EXPECT_THAT(kinds(), ElementsAre(Kind::ignored_materials));
    EXPECT_EQ(warnings()[0].text,
              "\"m.obj\": the 2 materials of \"my lib.mtl\" aren't read; give the object "
              "\"materials\", like {\"a\": NAME}");
    json["objects"][0]["materials"] = {{"b", "red"}};
    EXPECT_THAT(kinds(), IsEmpty());
    json["objects"][0].erase("materials");
    put_bytes(folder / "m.obj", "mtllib my lib.mtl\n" + faces + "f 2 3 4\nf 3 1 4\n");
    EXPECT_THAT(kinds(), IsEmpty());  // one group, which has a material of the scene
    put_bytes(folder / "my lib.mtl", "newmtl a\nKd 1 0 0\n  map_Kd wood.png\n");
    EXPECT_THAT(kinds(), ElementsAre(Kind::ignored_materials));
    EXPECT_EQ(
        warnings()[0].text,
        "\"m.obj\": its texture \"wood.png\" isn't shown: no face says which part of it is its "
        "own");
    const std::string places = "vt 0 0\nvt 1 0\nvt 0 1\nmtllib my lib.mtl\n";
    put_bytes(folder / "m.obj", places + faces + "f 2/1 3/2 4/3\nf 3/1 1/2 4/3\n");
    EXPECT_THAT(kinds(), ElementsAre(Kind::ignored_materials));
    EXPECT_EQ(warnings()[0].text, "\"m.obj\": its texture \"wood.png\" isn't in its folder");
    put_bytes(folder / "wood.png", "no picture");
    EXPECT_THAT(warnings()[0].text, HasSubstr("neither PNG nor JPEG"));
}

constexpr const char* kTetrahedron =
    "v 0 0 0\nv .5 0 0\nv 0 .5 0\nv 0 0 .5\nvt 0 0\nvt 1 0\nvt 0 1\n"
    "usemtl a\nf 1/1 3/2 2/3\nf 1/1 2/2 4/3\n";

/// The warnings about a file without a scene.
std::vector<std::string> sentences_on(const std::filesystem::path& file) {
    AssetStore assets;
    const Scene scene = parse_scene(
        scene_of_file(file, file.filename().string(), {}, assets), file, {file.parent_path()},
        [&](const Model& model, bool keeps) { return assets.box_of_file(model, keeps); });
    std::vector<std::string> sentences;
    for (const Warning& warning : scene_warnings(scene, std::vector<int>{1}, assets))
        if (warning.kind == WarningKind::ignored_materials) sentences.push_back(warning.text);
    return sentences;
}

TEST_F(MeshWarnings, NameTheMissingLibraryOfAFileWithoutAScene) {
    const auto file = folder / "m.obj";
    put_bytes(file, std::string("mtllib a.mtl\n") + kTetrahedron + "f 2 3 4\nf 3 1 4\n");
    EXPECT_THAT(sentences_on(file),
                ElementsAre("\"m.obj\": its material library \"a.mtl\" isn't in its folder; give "
                            "the object a \"material\" of the scene"));
    put_bytes(folder / "a.mtl", "newmtl b\nKd 1 0 0\n");
    EXPECT_THAT(sentences_on(file),
                ElementsAre("\"m.obj\": its material \"a\" isn't in \"a.mtl\"; give the object a "
                            "\"material\" of the scene"));
    put_bytes(folder / "a.mtl", "newmtl a\nKd 1 0 0\n");
    EXPECT_THAT(sentences_on(file), IsEmpty());
    put_bytes(file, std::string(kTetrahedron) + "f 2 3 4\nf 3 1 4\n");
    EXPECT_THAT(sentences_on(file),
                ElementsAre("\"m.obj\": it names no library that has its material \"a\"; give "
                            "the object a \"material\" of the scene"));
}

TEST_F(MeshWarnings, NameEachMissingMaterialAndTextureOnce) {
    const auto file = folder / "m.obj";
    put_bytes(file, std::string("mtllib a.mtl\nmtllib b.mtl\n") + kTetrahedron +
                        "usemtl b\nf 2/1 3/2 4/3\nusemtl None\nf 3/1 1/2 4/3\n");
    put_bytes(folder / "b.mtl", "newmtl b\nmap_Kd one.png\nmap_Ke two.png\nmap_Pr two.png\n");
    EXPECT_THAT(sentences_on(file),
                ElementsAre("\"m.obj\": its texture \"one.png\" isn't in its folder",
                            "\"m.obj\": its texture \"two.png\" isn't in its folder",
                            "\"m.obj\": its material library \"a.mtl\" isn't in its folder; give "
                            "the object \"materials\", like {\"a\": NAME}"));
    // Two objects show it, and one has a material for what the file lacks.
    json["models"]["ball"] = {{"mesh", "m.obj"}, {"surface", "exact"}};
    json["objects"][0].erase("material");
    json["objects"][0]["materials"] = {{"a", "red"}, {"b", "red"}};
    json["objects"].push_back(json["objects"][0]);
    json["objects"].back().erase("name");
    EXPECT_THAT(kinds(), ElementsAre(Kind::ignored_materials, Kind::ignored_materials));
}

TEST_F(MeshWarnings, NameEachMissingLibrary) {
    const auto file = folder / "m.obj";
    const std::string body = std::string(kTetrahedron) + "f 2 3 4\nf 3 1 4\n";
    put_bytes(folder / "here.mtl", "newmtl b\n");
    put_bytes(file, "mtllib a.mtl\nmtllib here.mtl\nmtllib b.mtl here.mtl c.mtl\n" + body);
    EXPECT_THAT(sentences_on(file),
                ElementsAre("\"m.obj\": its material libraries \"a.mtl\", \"b.mtl\" and "
                            "\"c.mtl\" aren't in its folder; give the object a \"material\" of "
                            "the scene"));
    std::string many;
    for (int i = 0; i < 20; ++i) many += fmt::format("mtllib {}.mtl\n", i);
    put_bytes(file, many + body);
    EXPECT_THAT(sentences_on(file), ElementsAre(HasSubstr("\"6.mtl\" and 13 more aren't in its")));
}

TEST_F(MeshWarnings, TellFilesOfOneNameApart) {
    for (const char* const name : {"one", "two"}) {
        std::filesystem::create_directory(folder / name);
        put_bytes(folder / name / "m.obj", std::string("mtllib a.mtl\n") + kTetrahedron);
        json["models"][name] = {{"mesh", std::string(name) + "/m.obj"}, {"surface", "exact"}};
    }
    json["objects"] = {{{"model", "one"}}, {{"model", "two"}}, {{"model", "one"}}};
    std::vector<std::string> found;
    for (const Warning& warning : warnings())
        found.push_back(warning.where.key + ": " + warning.text.substr(0, 29));
    EXPECT_THAT(found, ElementsAre("objects[0]: \"one/m.obj\": its material lib",
                                   "objects[1]: \"two/m.obj\": its material lib"));
}

TEST_F(MeshWarnings, AreAtMostNineOfAFile) {
    std::string mesh = std::string("mtllib a.mtl\n") + kTetrahedron, library;
    for (int i = 0; i < 20; ++i) {
        mesh += fmt::format("usemtl m{}\nf 2/1 3/2 4/3\n", i);
        library += fmt::format("newmtl m{0}\nmap_Kd {0}.png\n", i);
    }
    put_bytes(folder / "m.obj", mesh);
    put_bytes(folder / "a.mtl", library + "newmtl a\n");
    const std::vector<std::string> found = sentences_on(folder / "m.obj");
    ASSERT_EQ(found.size(), 9u);
    EXPECT_EQ(found.back(),
              "\"m.obj\": 12 more of what it has isn't shown; `voxelume info` lists it");
}

/// A glTF tetrahedron with a texture of one pixel.
std::string textured_gltf(const nlohmann::json& material) {
    GltfWriter writer;
    const int p =
        writer.accessor(std::vector<float>{0, 0, 0, 0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0.5f}, "VEC3", 3);
    const int t = writer.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}, "VEC2", 2);
    const int i =
        writer.accessor(std::vector<uint16_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}, "SCALAR", 1);
    Image texel{1, 1, {}, {}, {}};
    for (const char* channel : {"R", "G", "B"}) texel.planes[channel] = Plane<float>{0.5f};
    writer.json["images"] = {
        {{"uri", "data:image/png;base64," + GltfWriter::base64(png_bytes(texel, {}))}}};
    writer.json["textures"] = {{{"source", 0}}};
    writer.json["materials"] = nlohmann::json::array({material});
    writer.show(p, t, i);
    return writer.gltf();
}

TEST_F(MeshWarnings, NameWhatASurfaceDoesNotShowOfTextures) {
    const nlohmann::json texture = {{"index", 0}};
    const nlohmann::json plain = {{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}};
    nlohmann::json mapped = plain, clear = plain;
    mapped["pbrMetallicRoughness"]["metallicRoughnessTexture"] = texture;
    clear["alphaMode"] = "BLEND";
    const std::string maps =
        "\"m.gltf\": the roughness, metalness and emission of its textures aren't shown on "
        "\"cubes\": give the model \"surface\": \"smooth\" or \"exact\"";
    const std::string alpha =
        "\"m.gltf\": its alpha isn't shown on \"smooth\": give the model "
        "\"surface\": \"exact\"";
    const std::tuple<nlohmann::json, const char*, std::string> cases[] = {
        {plain, "cubes", ""},     {mapped, "cubes", maps}, {mapped, "smooth", ""},
        {clear, "smooth", alpha}, {clear, "exact", ""},    {mapped, "exact", ""}};
    for (const auto& [material, surface, text] : cases) {
        put_bytes(folder / "m.gltf", textured_gltf(material));
        json["models"]["ball"] = {{"mesh", "m.gltf"}, {"surface", surface}};
        const std::vector<Warning> found = warnings();
        ASSERT_EQ(found.size(), text.empty() ? 0u : 1u) << material << surface;
        if (text.empty()) continue;
        EXPECT_EQ(found[0].text, text);
    }
}

TEST_F(MeshWarnings, NameATextureOfPly) {
    put_bytes(folder / "m.ply",
              "ply\nformat ascii 1.0\ncomment TextureFile my wood.png\nelement vertex 4\n"
              "property float x\nproperty float y\nproperty float z\nelement face 4\n"
              "property list uchar int vertex_indices\nend_header\n0 0 0\n.5 0 0\n0 .5 0\n0 0 .5\n"
              "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
    json["models"]["ball"] = {{"mesh", "m.ply"}};
    EXPECT_THAT(kinds(), ElementsAre(Kind::ignored_materials));
    EXPECT_THAT(warnings()[0].text, HasSubstr("its texture \"my wood.png\" isn't shown"));
}

TEST_F(MeshWarnings, AnswerFromTheCacheWhatNeedsTheMesh) {
    show_mesh("ball.obj", ball({0, 0, 0}, 0.3, 32, 16));
    json["lights"][0]["position"] = {0.15, -0.45, 0.05};
    const Scene scene = parse_scene(json.dump(), folder / "room.json", {});
    const ModelCache cache(folder / "models", 1 << 20, 0);
    for (const uint64_t reads : {1, 0}) {
        AssetStore meshes(cache);
        const std::vector<Warning> found = scene_warnings(scene, std::vector{1}, meshes);
        ASSERT_EQ(found.size(), 1u);
        EXPECT_EQ(found[0].kind, Kind::light_inside_object);
        EXPECT_EQ(meshes.meshes_read(), reads);
    }
}

}  // namespace voxelume
