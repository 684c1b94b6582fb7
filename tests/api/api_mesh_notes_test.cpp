// SPDX-License-Identifier: Apache-2.0
// Descriptions of mesh files tell what isn't shown, and what was assumed.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "tests/api/api_fixture.hpp"

namespace voxelume::v1 {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ApiMeshNotes : public ApiTest {
  protected:
    void put(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name) << text;
    }

    /// The member of a file's description; null where there is none.
    const Facts* member(const std::string& file, const std::string& name) {
        facts_ = describe_file(folder / file);
        const auto& members = std::get<std::vector<Facts>>(facts_.value);
        const auto found = std::ranges::find(members, name, &Facts::name);
        return found == members.end() ? nullptr : &*found;
    }

    std::vector<std::string> notes_on(const std::string& file) {
        std::vector<std::string> sentences;
        const Facts* const notes = member(file, "notes");
        if (notes == nullptr) return sentences;
        for (const Facts& note : std::get<std::vector<Facts>>(notes->value))
            sentences.push_back(std::get<std::string>(note.value));
        return sentences;
    }

  private:
    Facts facts_;
};

TEST_F(ApiMeshNotes, TellOfBumpsAndMapsOfHighlightsOfLibraries) {
    put("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 2 0\nusemtl m\nf 1 2 3\n");
    put("a.mtl", "newmtl m\nKd 1 0 0\n");
    EXPECT_THAT(notes_on("a.obj"), IsEmpty());
    for (const char* bumps : {"map_Bump -bm 1 a.png\n", "norm a.png\n", "bump a.png\n"}) {
        put("a.mtl", std::string("newmtl m\n") + bumps);
        EXPECT_THAT(notes_on("a.obj"), ElementsAre(HasSubstr("surfaces have no bumps"))) << bumps;
    }
    put("a.mtl", "newmtl m\nmap_Ks a.png\nmap_Ns a.png\nnewmtl n\nmap_Ks b.png\n");
    EXPECT_THAT(notes_on("a.obj"), ElementsAre(HasSubstr("map_Ks and map_Ns aren't shown")));
}

TEST_F(ApiMeshNotes, TellThatColoursOfVerticesWereTakenForBytes) {
    put("a.obj", "v 0 0 0 255 0 0\nv 1 0 0 0 9 0\nv 0 2 0 0 0 7\nf 1 2 3\n");
    EXPECT_THAT(notes_on("a.obj"), ElementsAre("assumed: colours of vertices from 0 to 255, for "
                                               "some are above 1"));
}

TEST_F(ApiMeshNotes, TellWhichSurfacesShowTheAlphaOfVertices) {
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
        "float z\nproperty uchar alpha\nelement face 1\nproperty list uchar int vertex_indices\n"
        "end_header\n";
    put("a.ply", head + "0 0 0 255\n1 0 0 9\n0 2 0 0\n3 0 1 2\n");
    const Facts* const alpha = member("a.ply", "vertex alpha");
    ASSERT_NE(alpha, nullptr);
    EXPECT_EQ(std::get<std::string>(alpha->value), "only \"exact\" surfaces show it");
    EXPECT_EQ(member("a.ply", "textures"), nullptr);
    put("a.ply", head + "0 0 0 255\n1 0 0 255\n0 2 0 255\n3 0 1 2\n");
    EXPECT_EQ(member("a.ply", "vertex alpha"), nullptr);
}

}  // namespace
}  // namespace voxelume::v1
