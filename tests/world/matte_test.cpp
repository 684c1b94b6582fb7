// SPDX-License-Identifier: Apache-2.0
// Mattes of rendered images. The oracle is light: in a scene with a single emissive object, a
// pixel's light is proportional to the part of it that this object covers.
#include <gtest/gtest.h>

#include <bit>
#include <map>

#include "runtime/image/cryptomatte.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

/// Eight balls of three materials, some behind others, and a veil before some of them.
constexpr const char* kBalls = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]},
          "ambient": [0, 0, 0]},
"materials": {"red": {"diffuse": 0}, "green": {"diffuse": 0}, "veil": {"diffuse": 0, "opacity": 0.25}},
"models": {"ball": {"shape": "sphere", "radius": 0.22, "surface": "exact"},
           "pane": {"shape": "box", "size": [0.9, 0.7, 0.1], "surface": "cubes"}},
"objects": [{"name": "a", "model": "ball", "material": "red", "position": [-0.6, 0.3, 0]},
            {"name": "b", "model": "ball", "material": "green", "position": [-0.35, 0.35, 0.3]},
            {"name": "c", "model": "ball", "material": "red", "position": [0.1, 0.1, 0.1]},
            {"name": "d", "model": "ball", "material": "green", "position": [0.2, -0.2, 0.35]},
            {"name": "e", "model": "ball", "material": "red", "position": [0.5, -0.3, -0.1]},
            {"name": "pane", "model": "pane", "material": "veil", "position": [0.2, -0.4, -0.6]}],
"lights": [],
"observer": {"position": [0.1, 0.2, -4], "look_at": [0, 0, 0],
             "display": {"shape": "pyramid", "angle": 30, "far": 9}},
"render": {"size": [23, 17], "samples": 16}})";

Image image_of(Scene scene) {
    RenderReport report;
    return render(shared_device(), scene, report);
}

/// The part of each pixel that a name covers, from the planes of a layer alone.
std::vector<float> share_of(const Image& image, const std::string& layer, const std::string& name) {
    const float id = std::bit_cast<float>(cryptomatte_bits(name));
    std::vector<float> shares(size_t(image.width * image.height), 0.0f);
    for (const char* ranks : {"00", "01", "02"})
        for (const char* channels : {"RG", "BA"}) {
            const auto plane = [&](size_t i) -> const Plane<float>& {
                return image.planes.at(layer + ranks + "." + channels[i]);
            };
            for (size_t i = 0; i < shares.size(); ++i)
                if (plane(0)[i] == id) shares[i] += plane(1)[i];
        }
    return shares;
}

Scene balls() {
    Scene scene = parse_scene(kBalls, "balls.json", {});
    scene.render.channels.object_matte = scene.render.channels.material_matte = true;
    return scene;
}

TEST(Matte, AnObjectsShareIsTheLightOfAScreenWhereItAloneIsEmissive) {
    Scene scene = balls();
    scene.objects.pop_back();  // without the veil, all is opaque
    const Image image = image_of(scene);
    double edges = 0;
    for (size_t number = 0; number < scene.objects.size(); ++number) {
        Scene emissive = scene;
        emissive.materials.push_back(emissive.materials[1]);
        emissive.materials.back().emission = glm::vec3(1);
        emissive.objects[number].material = int(emissive.materials.size()) - 1;
        emissive.render.channels = {};
        const Image light = image_of(emissive);
        const auto shares = share_of(image, "CryptoObject", scene.objects[number].name);
        for (size_t i = 0; i < shares.size(); ++i) {
            ASSERT_EQ(shares[i], light.planes.at("R")[i]) << number << " at " << i;
            edges += double(shares[i] > 0 && shares[i] < 1);
        }
    }
    EXPECT_GT(edges, 40);
}

TEST(Matte, SharesSumToAlphaBehindAVeilToo) {
    const Scene scene = balls();
    const Image image = image_of(scene);
    const auto sums = [&](const std::string& layer, const auto& list) {
        std::vector<float> total(size_t(image.width * image.height), 0.0f);
        for (const auto& item : list) {
            const std::vector<float> shares = share_of(image, layer, item.name);
            for (size_t i = 0; i < total.size(); ++i) total[i] += shares[i];
        }
        return total;
    };
    const std::vector<float> objects = sums("CryptoObject", scene.objects);
    const std::vector<float> materials = sums("CryptoMaterial", scene.materials);
    size_t partly = 0;
    for (size_t i = 0; i < objects.size(); ++i) {
        const float alpha = image.planes.at("A")[i];
        EXPECT_NEAR(objects[i], alpha, 1e-6) << i;
        EXPECT_NEAR(materials[i], alpha, 1e-6) << i;
        partly += size_t(alpha > 0.2f && alpha < 0.5f);
    }
    EXPECT_GT(partly, 8u);  // the veil alone: its front and back
}

TEST(Matte, TheyAreTheSameWhicheverOtherChannelsThereAre) {
    const Scene scene = balls();
    const Image image = image_of(scene);
    for (const bool is_of_objects : {true, false}) {
        Scene bare = scene;
        bare.render.channels = {false, false, false, false, false};
        (is_of_objects ? bare.render.channels.object_matte : bare.render.channels.material_matte) =
            true;
        const Image matte = image_of(bare);
        ASSERT_EQ(matte.planes.size(), 12u);
        for (const auto& [name, plane] : matte.planes)
            EXPECT_EQ(plane, image.planes.at(name)) << name;
    }
}

TEST(Matte, RanksFallAndNumbersOfMaterialsAgree) {
    Scene scene = balls();
    scene.render.channels.material = true;
    const Image image = image_of(scene);
    const Image bare = [&] {
        Scene other = scene;
        other.render.channels = {};
        return image_of(other);
    }();
    for (const auto& [name, plane] : bare.planes) EXPECT_EQ(plane, image.planes.at(name)) << name;
    const auto& materials = image.id_planes.at("materialId");
    const auto& objects = image.id_planes.at("objectId");
    for (size_t i = 0; i < objects.size(); ++i) {
        const auto plane = [&](const char* name) { return image.planes.at(name)[i]; };
        EXPECT_GE(plane("CryptoObject00.G"), plane("CryptoObject00.A"));
        EXPECT_GE(plane("CryptoObject00.A"), plane("CryptoObject01.G"));
        EXPECT_GE(plane("CryptoMaterial00.G"), plane("CryptoMaterial00.A"));
        ASSERT_EQ(materials[i] == 0, objects[i] == 0);
        if (objects[i] == 0) continue;
        EXPECT_EQ(int(materials[i]) - 1, scene.objects[objects[i] - 1].material);
    }
}

TEST(Matte, WithoutItNothingIsCompiledOrAllocatedForIt) {
    DeviceCounters& device = shared_device().counters();
    device.launches.clear();
    device.allocated_bytes.clear();
    Scene scene = balls();
    scene.render.channels = {};
    image_of(scene);
    EXPECT_EQ(device.launches.count("rank_matte"), 0u);
    EXPECT_EQ(device.allocated_bytes.count("matte shares"), 0u);
    scene.render.channels.object_matte = true;
    image_of(scene);
    EXPECT_EQ(device.launches.at("rank_matte"), 1u);
    EXPECT_GT(device.allocated_bytes.at("matte shares"), 0u);
}

}  // namespace
}  // namespace voxelume
