// SPDX-License-Identifier: Apache-2.0
// Clips of glTF files: the scene's objects at random times against an evaluation written here.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <fstream>
#include <random>

#include "runtime/assets/asset_store.hpp"
#include "runtime/import/scene_of_file.hpp"
#include "runtime/io/gltf/gltf_animation.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/parsed_gltf.hpp"

namespace voxelume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;
using Numbers = std::vector<double>;
using Matrix4 = std::array<Numbers, 4>;  ///< rows

Matrix4 identity_rows() {
    return {Numbers{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
}

Matrix4 product_of_rows(const Matrix4& a, const Matrix4& b) {
    Matrix4 c{Numbers(4), Numbers(4), Numbers(4), Numbers(4)};
    for (size_t i = 0; i < 4; ++i)
        for (size_t j = 0; j < 4; ++j)
            for (size_t k = 0; k < 4; ++k) c[i][j] += a[i][k] * b[k][j];
    return c;
}

Numbers unit_length(Numbers q) {
    double sum = 0;
    for (const double v : q) sum += v * v;
    for (double& v : q) v /= std::sqrt(sum);
    return q;
}

Matrix4 rows_of(const Numbers& t, const Numbers& rotation, const Numbers& s) {
    const Numbers q = unit_length(rotation);
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    return {Numbers{s[0] * (1 - 2 * (y * y + z * z)), s[1] * 2 * (x * y - z * w),
                    s[2] * 2 * (x * z + y * w), t[0]},
            {s[0] * 2 * (x * y + z * w), s[1] * (1 - 2 * (x * x + z * z)),
             s[2] * 2 * (y * z - x * w), t[1]},
            {s[0] * 2 * (x * z - y * w), s[1] * 2 * (y * z + x * w),
             s[2] * (1 - 2 * (x * x + y * y)), t[2]},
            {0, 0, 0, 1}};
}

/// The values of a sampler as the format defines them.
struct TestSampler {
    std::string interpolation;
    std::vector<float> times;
    std::vector<float> values;
    size_t width = 3;

    Numbers part(size_t key, size_t which) const {
        const size_t parts = interpolation == "CUBICSPLINE" ? 3 : 1;
        const auto first =
            values.begin() + std::ptrdiff_t((key * parts + (parts == 3 ? which : 0)) * width);
        return {first, first + std::ptrdiff_t(width)};
    }

    Numbers at(double time) const {
        if (time <= times.front()) return part(0, 1);
        if (time >= times.back()) return part(times.size() - 1, 1);
        size_t key = 0;
        while (times[key + 1] <= time) ++key;
        const Numbers a = part(key, 1), b = part(key + 1, 1);
        if (interpolation == "STEP") return a;
        const double span = double(times[key + 1]) - double(times[key]);
        const double u = (time - times[key]) / span;
        if (interpolation == "CUBICSPLINE") {
            const Numbers out = part(key, 2), in = part(key + 1, 0);
            Numbers row(width);
            for (size_t i = 0; i < width; ++i)
                row[i] = (2 * u * u * u - 3 * u * u + 1) * a[i] +
                         span * (u * u * u - 2 * u * u + u) * out[i] +
                         (-2 * u * u * u + 3 * u * u) * b[i] + span * (u * u * u - u * u) * in[i];
            return row;
        }
        return width == 4 ? spherical(unit_length(a), unit_length(b), u) : mixed(a, b, 1 - u, u);
    }

    static Numbers mixed(const Numbers& a, const Numbers& b, double p, double q) {
        Numbers row(a.size());
        for (size_t i = 0; i < a.size(); ++i) row[i] = p * a[i] + q * b[i];
        return row;
    }

    static Numbers spherical(const Numbers& a, const Numbers& b, double u) {
        double dot = 0;
        for (size_t i = 0; i < 4; ++i) dot += a[i] * b[i];
        const double sign = dot < 0 ? -1 : 1, angle = std::acos(std::min(std::abs(dot), 1.0));
        if (angle < 1e-9) return a;
        return mixed(a, b, std::sin((1 - u) * angle) / std::sin(angle),
                     sign * std::sin(u * angle) / std::sin(angle));
    }
};

/// A tree of nodes that all show a triangle, with random places and samplers.
class RandomTree {
  public:
    explicit RandomTree(unsigned seed) : random_(seed) {
        writer_.json["nodes"] = Json::array();
        writer_.json["scenes"][0]["nodes"] = {0};
        for (int i = 0; i < kNodes; ++i) add_node(i);
        writer_.json["animations"][0]["name"] = "dance";
        for (int i = 0; i < kNodes; ++i) add_samplers(i);
    }

    const GltfWriter& writer() const { return writer_; }

    Matrix4 world_rows(int node, double time) const {
        Matrix4 map = identity_rows();
        for (; node >= 0; node = parents_[size_t(node)])
            map = product_of_rows(local_rows(size_t(node), time), map);
        return map;
    }

    static constexpr int kNodes = 24;

  private:
    float number(double least, double most) {
        return float(std::uniform_real_distribution<double>(least, most)(random_));
    }
    int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

    void add_node(int i) {
        Json node = {{"mesh", 0}, {"name", "node " + std::to_string(i)}};
        parents_.push_back(i == 0 ? -1 : below(i));
        if (i > 0) writer_.json["nodes"][size_t(parents_.back())]["children"].push_back(i);
        still_.push_back({Numbers{0, 0, 0}, Numbers{0, 0, 0, 1}, Numbers{1, 1, 1}});
        if (i % 3 != 1) {
            for (double& v : still_.back()[0]) v = number(-2, 2);
            for (double& v : still_.back()[1]) v = number(-1, 1);
            for (double& v : still_.back()[2]) v = number(0.6, 1.3);
            node["translation"] = still_.back()[0];
            node["rotation"] = still_.back()[1];
            node["scale"] = still_.back()[2];
        }
        writer_.json["nodes"].push_back(node);
    }

    void add_samplers(int i) {
        constexpr std::array kPaths = {"translation", "rotation", "scale"};
        samplers_.emplace_back();
        for (size_t path = 0; path < 3; ++path) {
            if (below(3) == 0 || i % 5 == 4) continue;
            const TestSampler sampler = random_sampler(path);
            samplers_.back()[path] = sampler;
            Json& animation = writer_.json["animations"][0];
            const int input = writer_.accessor(sampler.times, "SCALAR", 1);
            const int output =
                writer_.accessor(sampler.values, path == 1 ? "VEC4" : "VEC3", int(sampler.width));
            animation["channels"].push_back({{"sampler", animation["samplers"].size()},
                                             {"target", {{"node", i}, {"path", kPaths[path]}}}});
            animation["samplers"].push_back(
                {{"input", input}, {"output", output}, {"interpolation", sampler.interpolation}});
        }
    }

    TestSampler random_sampler(size_t path) {
        constexpr std::array kKinds = {"STEP", "LINEAR", "CUBICSPLINE"};
        TestSampler sampler{kKinds[size_t(below(3))], {number(0, 0.5)}, {}, path == 1 ? 4U : 3U};
        const int keys = 2 + below(6);
        while (int(sampler.times.size()) < keys)
            sampler.times.push_back(sampler.times.back() + number(0.1, 1.2));
        for (int key = 0; key < keys; ++key) {
            const bool is_spline = sampler.interpolation == "CUBICSPLINE";
            for (int part = is_spline ? 0 : 1; part < (is_spline ? 3 : 2); ++part)
                for (size_t c = 0; c < sampler.width; ++c)
                    sampler.values.push_back(part != 1   ? number(-0.1, 0.1)
                                             : path == 2 ? number(0.6, 1.4)
                                                         : number(-1, 1));
        }
        return sampler;
    }

    Matrix4 local_rows(size_t node, double time) const {
        std::array<Numbers, 3> values = still_[node];
        for (size_t path = 0; path < 3; ++path)
            if (!samplers_[node][path].times.empty()) values[path] = samplers_[node][path].at(time);
        return rows_of(values[0], values[1], values[2]);
    }

    std::mt19937 random_;
    GltfWriter writer_ = triangle_gltf();
    std::vector<int> parents_;
    std::vector<std::array<Numbers, 3>> still_;
    std::vector<std::array<TestSampler, 3>> samplers_;
};

class GltfMotionTest : public FileTest {
  protected:
    std::string text_of(const GltfWriter& writer, const ImportOptions& options = {}) {
        std::ofstream(folder / "a.glb", std::ios::binary) << writer.glb();
        AssetStore assets;
        return scene_of_file(folder / "a.glb", "a.glb", options, assets);
    }

    Scene scene_in(const std::string& text) {
        AssetStore assets;
        return parse_scene(text, folder / "a.json", {folder}, [&](const Model& model, bool keeps) {
            return assets.box_of_file(model, keeps);
        });
    }
};

glm::dmat4 object_named(const Scene& scene, const std::string& name) {
    for (const Object& object : scene.objects)
        if (object.name == name) return object.world_from_object;
    ADD_FAILURE() << "no object " << name;
    return glm::dmat4(0);
}

/// A triangle that a clip moves by a sampler of one path.
GltfWriter moved_triangle(const char* path, const std::vector<float>& times,
                          const std::vector<float>& values, const char* name = nullptr) {
    GltfWriter writer = triangle_gltf();
    const int input = writer.accessor(times, "SCALAR", 1);
    const bool is_turn = std::string(path) == "rotation";
    const int output = writer.accessor(values, is_turn ? "VEC4" : "VEC3", is_turn ? 4 : 3);
    Json& animation = writer.json["animations"][0];
    if (name) animation["name"] = name;
    animation["channels"] = {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}};
    animation["samplers"] = {{{"input", input}, {"output", output}}};
    return writer;
}

}  // namespace

TEST_F(GltfMotionTest, MovesObjectsAsTheFormatSaysAtAnyTime) {
    for (const unsigned seed : {1U, 2U, 3U}) {
        const RandomTree tree(seed);
        const Scene scene = scene_in(text_of(tree.writer()));
        ASSERT_EQ(scene.objects.size(), size_t(RandomTree::kNodes) + 1) << "and the ground";
        std::mt19937 random(seed + 100);
        std::uniform_real_distribution<double> time(-0.5, 8);
        double worst = 0;
        for (int i = 0; i < 100; ++i) {
            const double t = time(random);
            const Scene now = scene_at(scene, 1 + t * scene.animation.fps);
            for (int node = 0; node < RandomTree::kNodes; ++node) {
                const Matrix4 expected = tree.world_rows(node, t);
                const glm::dmat4 map = object_named(now, "node " + std::to_string(node));
                for (int row = 0; row < 3; ++row)
                    for (int column = 0; column < 4; ++column)
                        worst = std::max(worst, std::abs(map[column][row] -
                                                         expected[size_t(row)][size_t(column)]));
            }
        }
        EXPECT_LT(worst, 1e-6) << "seed " << seed;
    }
}

TEST_F(GltfMotionTest, HasAsManyFramesAsItsClipAndAFiner) {
    const std::string text =
        text_of(moved_triangle("translation", {0, 0.5F, 2}, {0, 0, 0, 10, 0, 0, 10, 10, 0}));
    const Scene scene = scene_in(text);
    EXPECT_EQ(scene.animation.frames, 49);
    EXPECT_TRUE(scene.objects[0].moves);
    EXPECT_EQ(glm::dvec3(scene_at(scene, 7).objects[0].world_from_object[3]), glm::dvec3(5, 0, 0));
    EXPECT_THAT(text, HasSubstr("\"target\": \"objects.object.position\""));
    EXPECT_GE(scene.fitted.shown.max.x, 17) << "the world holds all frames";
    const GltfWriter still = triangle_gltf();
    EXPECT_THAT(text_of(still), Not(HasSubstr("animation")));
    EXPECT_EQ(scene_in(text_of(still)).animation.frames, 1);
}

TEST_F(GltfMotionTest, ShowsTheClipThatIsAskedFor) {
    GltfWriter writer = moved_triangle("translation", {0, 1}, {1, 1, 1, 2, 1, 1}, "walk");
    writer.json["animations"].push_back(writer.json["animations"][0]);
    writer.json["animations"].push_back(writer.json["animations"][0]);
    writer.json["animations"][1].erase("name");
    writer.json["animations"][2]["channels"][0]["target"]["path"] = "scale";
    EXPECT_THAT(gltf_clip_names(parsed_gltf(writer)), ElementsAre("walk", "clip 2", "walk 3"));
    EXPECT_EQ(gltf_clip(parsed_gltf(writer), 1).seconds, 1);
    EXPECT_THAT(text_of(writer), HasSubstr("objects.object.position"));
    ImportOptions options;
    options.clip = "walk 3";
    EXPECT_THAT(text_of(writer, options), HasSubstr("objects.object.scale"));
    options.clip = "wlak";
    const Error error = error_of([&] { text_of(writer, options); });
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(), HasSubstr("has no clip \"wlak\"; did you mean \"walk\"?"));
}

TEST_F(GltfMotionTest, ObjectsThatVanishByTheirScaleBecomeTiny) {
    const std::string text = text_of(moved_triangle("scale", {0, 1}, {0, 0, 0, 2, 2, 2}));
    const Scene scene = scene_in(text);
    EXPECT_NEAR(scene.objects[0].world_from_object[0].x, 2e-4, 1e-12);
    EXPECT_EQ(scene_at(scene, 25).objects[0].world_from_object[0].x, 2);
}

TEST_F(GltfMotionTest, CamerasAndLightsMoveFrameByFrame) {
    GltfWriter writer = moved_triangle(
        "rotation", {0, 1}, {0, 0, 0, 1, 0, float(std::sqrt(0.5)), 0, float(std::sqrt(0.5))});
    writer.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 1}}}}};
    writer.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}}};
    writer.json["nodes"][0]["children"] = {1, 2};
    writer.json["nodes"].push_back({{"camera", 0}, {"translation", {3, 2, 20}}});
    writer.json["nodes"].push_back({{"name", "lamp"},
                                    {"translation", {0, 9, 1}},
                                    {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const Scene scene = scene_in(text_of(writer));
    // A quarter about Y takes (3, 2, 20) to (20, 2, -3), and -Z to -X.
    const Scene last = scene_at(scene, 25);
    EXPECT_LT(glm::distance(last.observer.position, glm::dvec3(20, 2, -3)), 1e-6);
    EXPECT_LT(glm::distance(glm::dvec3(last.lights[0].position), glm::dvec3(1, 9, 0)), 1e-6);
    EXPECT_LT(glm::distance(glm::dvec3(last.lights[0].direction), glm::dvec3(-1, 0, 0)), 1e-6);
    EXPECT_LT(glm::distance(scene.observer.position, glm::dvec3(3, 2, 20)), 1e-6);
}

TEST(GltfClips, ThatAreDamagedAreRefused) {
    const auto refused = [](GltfWriter writer, const std::function<void(Json&)>& damage) {
        damage(writer.json);
        return std::string(error_of([&] { gltf_clip(parsed_gltf(writer), 0); }).what());
    };
    const GltfWriter good = moved_triangle("translation", {0, 1}, {0, 0, 0, 1, 0, 0});
    EXPECT_THAT(refused(moved_triangle("translation", {1, 1}, {0, 0, 0, 1, 0, 0}), [](Json&) {}),
                HasSubstr("animations[0].samplers[0]: a key at 1 s comes after one at 1 s"));
    EXPECT_THAT(refused(moved_triangle("translation", {0, 1, 2}, {0, 0, 0, 1, 0, 0}), [](Json&) {}),
                HasSubstr("3 keys, and 2 values"));
    EXPECT_THAT(refused(moved_triangle("rotation", {0}, {0, 0, 0, 0}), [](Json&) {}),
                HasSubstr("a rotation is [0, 0, 0, 0]"));
    EXPECT_THAT(refused(moved_triangle("translation", {0}, {NAN, 0, 0}), [](Json&) {}),
                HasSubstr("isn't a number"));
    EXPECT_THAT(refused(moved_triangle("translation", {NAN}, {0, 0, 0}), [](Json&) {}),
                HasSubstr("time isn't a number"));
    const auto in_animation = [&](const char* path, const Json& value) {
        return refused(
            good, [&](Json& json) { json["animations"][0][Json::json_pointer(path)] = value; });
    };
    EXPECT_THAT(in_animation("/samplers/0/interpolation", "CUBIC"), HasSubstr("no interpolation"));
    EXPECT_THAT(in_animation("/samplers/0/interpolation", "CUBICSPLINE"),
                HasSubstr("2 keys, and 2 values"));
    EXPECT_THAT(in_animation("/samplers/0/output", 99), HasSubstr("the file has 3 of these"));
    EXPECT_THAT(in_animation("/channels/0/sampler", 1), HasSubstr("the file has 1 of these"));
    EXPECT_THAT(in_animation("/channels/0/target/node", 7), HasSubstr("the file has 1 of these"));
    EXPECT_THAT(refused(good,
                        [](Json& json) {
                            Json& channels = json["animations"][0]["channels"];
                            channels.push_back(channels[0]);
                        }),
                HasSubstr("what another channel changes already"));
}

}  // namespace voxelume
