// SPDX-License-Identifier: Apache-2.0
// Images of observers inside glass meshes and smooth bodies, against an analytic tracer; only
// tracing finds the glass.
#include <nlohmann/json.hpp>

#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/analytic_comparison.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

/// A scene of a block of glass 1.6 x 1.2 x 1.4 m around an observer, with a painted ring and a ball
/// of water in it, over a floor. `block` is the block's model.
std::string block_scene(const std::string& block, const std::string& observer) {
    return R"({"voxelume": 1,
 "world": {"voxel_size": 0.02, "bounds": {"min": [-1.5, -1, -1.3], "max": [1.7, 1.2, 1.4]}, "background": [0.3, 0.4, 0.6],
           "ambient": [0.2, 0.1, 0.3], "medium": {"absorption": [0.1, 0.05, 0.2], "color": [0.5, 0.4, 0.3]}},
 "materials": {
  "floor": {"color": [0.7, 0.6, 0.5], "checker": {"color": [0.1, 0.2, 0.3], "size": [0.9, 0, 1.1], "origin": [0.05, 0, 0.1]}},
  "glass": {"diffuse": 0, "reflection": 1, "refraction": 1, "fresnel": true, "ior": 1.4, "absorption": [0.6, 0.2, 0.1]},
  "water": {"diffuse": 0, "reflection": 1, "refraction": 1, "fresnel": true, "ior": 1.33, "absorption": [0.1, 1.2, 0.3]},
  "paint": {"color": [0.8, 0.3, 0.2], "specular": 0.4, "reflection": 0.3}},
 "models": {
  "floor": {"shape": "box", "size": [3, 0.06, 2.5], "surface": "exact"},
  "block": )" +
           block + R"(,
  "drop": {"shape": "sphere", "radius": 0.2, "surface": "exact"},
  "ring": {"shape": "torus", "radius": 0.3, "tube": 0.1, "surface": "exact"}},
 "objects": [
  {"model": "floor", "material": "floor", "position": [0.1, -0.9, 0]},
  {"model": "block", "material": "glass", "position": [0.05, 0.1, 0.02]},
  {"model": "drop", "material": "water", "position": [0.1, 0.25, -0.2], "priority": 3},
  {"model": "ring", "material": "paint", "position": [0.2, 0, -0.1], "turn": [20, 50, 10]}],
 "lights": [{"type": "directional", "direction": [1, -2, -1.5], "color": [0.5, 0.6, 0.4]}],
 "observer": )" +
           observer + R"(,
 "render": {"size": [172, 133], "depth": 2, "shadow": "filtered"}})";
}

constexpr const char* kExactBlock =
    R"({"shape": "box", "size": [1.6, 1.2, 1.4], "surface": "exact"})";
/// An observer whose rays first meet the ring, the drop or the block's walls.
constexpr const char* kInTheMiddle =
    R"({"position": [0.3, 0.2, 0.55], "look_at": [0.1, 0.05, -0.2], "display": {"shape": "pyramid", "angle": 80}})";
/// An observer in open space in front of the block. All but a few rays begin on a near plane inside
/// the block.
constexpr const char* kInFront =
    R"({"position": [0.5, 0.3, 1.1], "look_at": [0.1, 0.05, -0.2], "display": {"shape": "pyramid", "angle": 60, "near": 0.5}})";

class ObserverInMediumMesh : public FileTest {
  protected:
    /// Writes a closed mesh of the block.
    void SetUp() override {
        FileTest::SetUp();
        write_obj(folder / "block.obj", box({-0.8f, -0.6f, -0.7f}, {0.8f, 0.6f, 0.7f}));
    }

    Scene scene(const std::string& block, const std::string& observer) const {
        return parse_scene(block_scene(block, observer), "test.json", {folder});
    }
};

TEST_F(ObserverInMediumMesh, AbsorbsFromTheObserverOnWhateverIsMetFirst) {
    for (const char* observer : {kInTheMiddle, kInFront})
        expect_image(scene(R"({"mesh": "block.obj", "surface": "exact"})", observer),
                     oracle::analytic_image(scene(kExactBlock, observer)), 1e-5, 1e-3);
}

TEST_F(ObserverInMediumMesh, ASmoothBodyAbsorbsFromTheObserverOnWhateverIsMetFirst) {
    const std::string ball = R"({"shape": "sphere", "radius": 0.7, "surface": )";
    expect_image(scene(ball + R"("smooth"})", kInTheMiddle),
                 oracle::analytic_image(scene(ball + R"("exact"})", kInTheMiddle)), 1e-3, 2e-2);
}

/// The block's walls are found behind the crate.
TEST_F(ObserverInMediumMesh, AnInstanceOfOpaqueCubesHidesNoWalls) {
    const auto with_crate = [&](const char* placement) {
        nlohmann::json json = nlohmann::json::parse(
            block_scene(R"({"mesh": "block.obj", "surface": "exact"})", kInTheMiddle));
        json["models"]["crate"] = {
            {"shape", "box"}, {"size", {0.2, 0.2, 0.2}}, {"surface", "cubes"}, {"set", "solid"}};
        json["objects"].push_back({{"model", "crate"},
                                   {"material", "floor"},
                                   {"position", {0.1, 0.1, 0.2}},
                                   {"placement", placement}});
        RenderReport report;
        return render(test_device(), parse_scene(json.dump(), "test.json", {folder}), report);
    };
    const Image in_world = with_crate("world"), instance = with_crate("instance");
    size_t pixels = 0, others = 0;
    for (size_t i = 0; i < in_world.planes.at("R").size(); ++i) {
        if (in_world.id_planes.at("objectId")[i] != instance.id_planes.at("objectId")[i]) continue;
        ++pixels;
        for (const char* color : {"R", "G", "B"})
            others += std::abs(in_world.planes.at(color)[i] - instance.planes.at(color)[i]) > 1e-3f;
    }
    EXPECT_GT(pixels, in_world.planes.at("R").size() * 99 / 100);
    EXPECT_LT(others, pixels / 100);
}

}  // namespace
}  // namespace voxelume
