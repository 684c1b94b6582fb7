// SPDX-License-Identifier: Apache-2.0
// Wavefront material libraries, and where the files that meshes name may lie.
#include "runtime/io/mesh/material_library.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/io/mesh/companion_file.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::IsEmpty;

using Companions = FileTest;

}  // namespace

TEST(MaterialLibrary, TakesWhatMaterialsHaveHere) {
    const auto materials = parse_material_library(
        "# any\nKd 1 1 1\nnewmtl  my wood \r\n\tKd 0.1 0.2 0.3\r\nKs .5\nKe 1 2 3\nNs 12.5\n"
        "Ni 1.25\nd 0.75\nillum 7\nmap_Kd -clamp on -o 0.5 0.25 -s 2 my wood.png\n"
        "newmtl b\nTr 0.25\nKa 9 9 9\nKd spectral a.rfl\nNs nan\nillum 77\n"
        "map_Kd -bm 1 -s 2 3 4 a.jpg\n");
    ASSERT_EQ(materials.size(), 2u);
    const MtlMaterial& a = materials[0];
    EXPECT_EQ(a.name, "my wood");
    EXPECT_NEAR(a.diffuse.z, 0.3, 1e-7);
    EXPECT_EQ(a.specular, glm::dvec3(0.5));
    EXPECT_EQ(a.emission, glm::dvec3(1, 2, 3));
    EXPECT_EQ(a.exponent, 12.5);
    EXPECT_EQ(a.ior, 1.25);
    EXPECT_EQ(a.opacity, 0.75);
    EXPECT_EQ(a.illumination, 7);
    EXPECT_EQ(a.diffuse_map.file, "my wood.png");
    EXPECT_TRUE(a.diffuse_map.clamps);
    EXPECT_EQ(a.diffuse_map.offset, glm::dvec2(0.5, 0.25));
    EXPECT_EQ(a.diffuse_map.scale, glm::dvec2(2, 1));
    const MtlMaterial& b = materials[1];
    EXPECT_EQ(b.opacity, 0.75);
    EXPECT_EQ(b.diffuse, glm::dvec3(0.8)) << "a spectral curve isn't read";
    EXPECT_EQ(b.exponent, 0);
    EXPECT_EQ(b.illumination, 2);
    EXPECT_EQ(b.diffuse_map.file, "a.jpg");
    EXPECT_EQ(b.diffuse_map.scale, glm::dvec2(2, 3));
}

TEST(MaterialLibrary, IsEmptyForWhatIsNone) {
    EXPECT_THAT(parse_material_library(""), IsEmpty());
    EXPECT_THAT(parse_material_library(std::string(5000, '\0')), IsEmpty());
    EXPECT_THAT(parse_material_library("map_Kd -o -o -s\n\n  \n"), IsEmpty());
    EXPECT_EQ(parse_material_library("\xEF\xBB\xBFnewmtl a\r\n").at(0).name, "a");
    const auto odd = parse_material_library("newmtl\nmap_Kd -o 1 2\nmap_Kd\nKd\nd");
    ASSERT_EQ(odd.size(), 1u);
    EXPECT_EQ(odd[0].name, "");
    EXPECT_EQ(odd[0].diffuse_map.file, "");
}

TEST(MaterialLibrary, NamesThatAreNoUtf8AreLatin1InBothFiles) {
    const std::string latin = "Terraind\xF6k", broken = "a\xE4\xB8", long_form = "\xC0\xAF";
    const auto name = [](const std::string& text) {
        return parse_material_library("newmtl " + text + "\n").at(0).name;
    };
    EXPECT_EQ(name(latin), "Terraind\xC3\xB6k");
    EXPECT_EQ(name("\xE4\xB8\xAD \xF0\x9F\x98\x80"), "\xE4\xB8\xAD \xF0\x9F\x98\x80");
    EXPECT_EQ(name(broken), "a\xC3\xA4\xC2\xB8");
    EXPECT_EQ(name(long_form), "\xC3\x80\xC2\xAF");
    const std::string vertices = "v 0 0 0\nv 7 0 0\nv 0 5 3\n";
    EXPECT_THAT(parse_mesh(vertices + "usemtl " + latin + "\nf 1 2 3\n", "a.obj").group_names,
                ElementsAre("Terraind\xC3\xB6k"));
}

TEST_F(Companions, OfOneNameAreOneFileWithSpacesOrSeveral) {
    const fs::path mesh = folder / "m.obj";
    put_bytes(folder / "a.mtl", "newmtl a\n");
    put_bytes(folder / "b.mtl", "newmtl b\n");
    std::vector<std::string> faults;
    const auto names = [&](const std::vector<std::string>& libraries) {
        std::vector<std::string> found;
        faults.clear();
        for (const MtlMaterial& material : read_material_libraries(mesh, libraries, faults))
            found.push_back(material.name);
        return found;
    };
    EXPECT_THAT(names({"a.mtl b.mtl"}), ElementsAre("a", "b"));
    EXPECT_THAT(names({"b.mtl", "a.mtl"}), ElementsAre("b", "a"));
    EXPECT_THAT(faults, IsEmpty());
    EXPECT_THAT(names({"a.mtl c.mtl", "not there.mtl"}), ElementsAre("a"));
    EXPECT_THAT(faults,
                ElementsAre("its material libraries \"c.mtl\" and \"not there.mtl\" aren't in "
                            "its folder"));
    EXPECT_THAT(names({}), IsEmpty());
    put_bytes(folder / "a.mtl b.mtl", "newmtl c\n");
    EXPECT_THAT(names({"a.mtl b.mtl"}), ElementsAre("c"));
    fs::resize_file(folder / "b.mtl", (uintmax_t{64} << 20) + 1);
    EXPECT_THAT(names({"b.mtl"}), IsEmpty());
    EXPECT_THAT(faults,
                ElementsAre("its material library \"b.mtl\" isn't read: it has more than 64 MiB"));
}

TEST_F(Companions, LieInTheFolderOfTheFileThatNamesThem) {
    const fs::path inside = folder / "in", mesh = inside / "m.obj";
    fs::create_directories(inside / "sub");
    put_bytes(inside / "sub" / "a.png", "a");
    put_bytes(inside / "b.png", "b");
    put_bytes(folder / "c.png", "c");
    fs::create_symlink(folder / "c.png", inside / "link.png");
    fs::create_symlink(inside / "b.png", inside / "near.png");
    const auto found = [&](const std::string& name) { return companion_file(mesh, name); };
    EXPECT_EQ(found("sub/a.png"), fs::canonical(inside / "sub" / "a.png"));
    EXPECT_EQ(found(".\\sub\\a.png"), fs::canonical(inside / "sub" / "a.png"));
    EXPECT_EQ(found("C:\\art\\b.png"), fs::canonical(inside / "b.png"));
    EXPECT_EQ(found("../in/b.png"), fs::canonical(inside / "b.png"));
    EXPECT_EQ(found("near.png"), fs::canonical(inside / "b.png"));
    EXPECT_EQ(found((inside / "b.png").string()), fs::canonical(inside / "b.png"));
    for (const std::string name :
         {"../c.png", "link.png", "sub", "", ".", "..", "/etc/passwd", "none.png"})
        EXPECT_EQ(found(name), std::nullopt) << name;
    EXPECT_EQ(found((folder / "c.png").string()), std::nullopt);
    EXPECT_EQ(found(std::string("b.png\0", 6)), std::nullopt);
}

}  // namespace voxelume
