// SPDX-License-Identifier: Apache-2.0
// Every value that may change, between its keys, against the scene whose text has that value.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "runtime/base/error.hpp"
#include "runtime/scene/parts/light.hpp"
#include "runtime/scene/parts/observer.hpp"
#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/scene/parts/solid.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/scene/moving_scene.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using nlohmann::json;

/// The scene without text places and motions' identities, which differ between scenes read from two
/// texts.
Scene without_source_positions(Scene scene) {
    scene.motion = nullptr;
    scene.world.where = {};
    if (auto* grid = std::get_if<GridDensity>(&scene.world.medium.density)) grid->where = {};
    for (Model& model : scene.models) model.where = {};
    for (Light& light : scene.lights) light.where = {};
    for (Object& object : scene.objects) {
        object.where = {};
        object.moves = false;
    }
    scene.observer.where = {};
    return scene;
}

class SceneFrames : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        for (const char* file : {"m.obj", "m.glb", "m.vdb"}) put_bytes(folder / file, "v 0 0 0\n");
    }

    Scene parse(const json& scene) const { return parse_scene(scene.dump(), "s.json", {folder}); }

    /// The path of a track to a place in a document.
    static std::string target_of(const json::json_pointer& place) {
        std::string target;
        std::string rest = place.to_string();
        while (!rest.empty()) {
            const size_t end = std::min(rest.find('/', 1), rest.size());
            const std::string step = rest.substr(1, end - 1);
            const bool is_number = step.find_first_not_of("0123456789") == step.npos;
            target += is_number ? "[" + step + "]" : (target.empty() ? "" : ".") + step;
            rest.erase(0, end);
        }
        return target;
    }

    /// A different value; for a direction, a different direction.
    static json scaled(const json& value, double factor) {
        if (value.is_number()) return value.get<double>() * factor;
        json list = json::array();
        for (const json& item : value)
            list.push_back(scaled(item, factor - 0.05 * double(list.size())));
        return list;
    }

    static json between(const json& a, const json& b, double share) {
        if (a.is_number()) return a.get<double>() * (1 - share) + b.get<double>() * share;
        json list = json::array();
        for (size_t i = 0; i < a.size(); ++i) list.push_back(between(a[i], b[i], share));
        return list;
    }

    /// Adds a track that changes the value at a place, and compares the scene between its keys.
    void expect_moved(const json& document, const json::json_pointer& place) {
        const std::string target = target_of(place);
        const json& value = document[place];
        const json last = scaled(value, 0.75);
        json moving = document, still = document;
        moving["animation"]["tracks"] = {
            {{"target", target},
             {"keys", {{{"frame", 1}, {"value", value}}, {{"frame", 5}, {"value", last}}}}}};
        const double share = (2.25 - 1) / 4;
        still[place] = between(value, last, share);
        const Scene now = scene_at(parse(moving), 2.25);
        EXPECT_TRUE(without_source_positions(now) == without_source_positions(parse(still)))
            << target;
        EXPECT_FALSE(without_source_positions(now) == without_source_positions(parse(document)))
            << target;
    }

    /// Adds tracks that change each number and vector of a part of a document, and each of its
    /// numbers.
    void expect_all_moved(const json& document, const json::json_pointer& place) {
        for (const auto& [key, value] : document[place].items()) {
            const json::json_pointer at = place / key;
            const bool is_list = value.is_array() && !value.empty() && value[0].is_number();
            if (value.is_structured() && !is_list) {
                expect_items_moved(document, at);
                continue;
            }
            if (!value.is_number() && !is_list) continue;
            if (key == "voxel_size" || key == "resolution" || key == "part" || key == "skin")
                continue;
            changed_.insert(key);
            expect_moved(document, at);
            for (size_t i = 0; is_list && i < value.size(); ++i)
                if (value[i] != 0) expect_moved(document, at / i);
        }
    }
    void expect_items_moved(const json& document, const json::json_pointer& place) {
        if (document[place].is_object()) return expect_all_moved(document, place);
        for (size_t i = 0; i < document[place].size(); ++i) expect_all_moved(document, place / i);
    }

    template <class Part>
    void expect_changed(std::span<const ValueRow<Part>> rows) const {
        for (const ValueRow<Part>& row : rows) {
            Part part;
            const Slot slot = row.slot(part);
            if (!row.is_animated || std::holds_alternative<bool*>(slot)) continue;
            EXPECT_TRUE(changed_.contains(std::string(row.key))) << row.key;
        }
    }

    std::set<std::string> changed_;
};

}  // namespace

TEST_F(SceneFrames, AreTheSceneWhoseTextHasTheirValues) {
    const json scene = full_scene();
    for (const char* part : {"/materials", "/models", "/objects", "/lights", "/observer"})
        expect_items_moved(scene, json::json_pointer(part));
    for (const char* part : {"/world/background", "/world/ambient"})
        expect_moved(scene, json::json_pointer(part));
    expect_all_moved(scene, json::json_pointer("/world/medium"));
    for (const auto& [place, part] : other_parts()) {
        json other = scene;
        other[json::json_pointer(place)] = part;
        expect_items_moved(other, json::json_pointer(place));
    }
    expect_changed(medium_rows());
    expect_changed(height_density_rows());
    expect_changed(ball_density_rows());
    expect_changed(material_rows());
    expect_changed(checker_rows());
    expect_changed(morph_rows());
    expect_changed(solid_rows());
    expect_changed(factor_rows());
    expect_changed(light_rows());
    expect_changed(observer_rows());
    expect_changed(display_rows());
}

TEST_F(SceneFrames, ChangeSwitchesNamesAndFilesAtTheirKeys) {
    json scene = full_scene();
    put_bytes(folder / "n.obj", "v 0 0 0\n");
    const auto track = [](const char* target, const json& from, const json& to) {
        return json{{"target", target},
                    {"keys", {{{"frame", 2}, {"value", from}}, {{"frame", 4}, {"value", to}}}}};
    };
    scene["materials"]["blue"] = {{"color", {0, 0, 1}}};
    scene["animation"]["tracks"] = {
        track("objects.egg.visible", true, false), track("objects.egg.model", "egg", "ring"),
        track("objects.egg.material", "default", "blue"),
        track("materials.red.fresnel", false, true), track("models.cut.mesh", "m.obj", "n.obj")};
    const Scene read = parse(scene), before = scene_at(read, 3.9), after = scene_at(read, 4);
    EXPECT_TRUE(before.objects[0].visible);
    EXPECT_FALSE(after.objects[0].visible);
    EXPECT_EQ(before.models[size_t(before.objects[0].model)].name, "egg");
    EXPECT_EQ(after.models[size_t(after.objects[0].model)].name, "ring");
    EXPECT_EQ(before.materials[size_t(before.objects[0].material)].name, "default");
    EXPECT_EQ(after.materials[size_t(after.objects[0].material)].name, "blue");
    const auto red = std::ranges::find(after.materials, "red", &Material::name);
    EXPECT_TRUE(red->fresnel);
    EXPECT_EQ(before.models[0].name, "block");
    const auto file = [](const Scene& of) {
        return std::ranges::find(of.models, "cut", &Model::name)->mesh.filename();
    };
    EXPECT_EQ(file(before), "m.obj");
    EXPECT_EQ(file(after), "n.obj");
}

TEST_F(SceneFrames, WhoseValuesDontGoTogetherNameTheirPlace) {
    struct Case {
        const char* part;
        const char* value;
        const char* target;
        const char* from;
        const char* to;
        const char* message;
    };
    const Case cases[] = {
        {"/lights/1/look_at", "[0, 2, -3]", "lights[1].look_at", "[-2, 2, -3]", "[0, 2, -3]",
         "lights[1].look_at: is the position itself; name a point away from it (at frame 3)"},
        {"/lights/2/direction", "[1, 2, 3]", "lights[2].direction", "[1, 2, 3]", "[-1, -2, -3]",
         "lights[2].direction: must not be zero, since it gives a direction (at frame 3)"},
        {"/lights/4/up", "[1, 0, 0]", "lights[4].up", "[1, -2, 2]", "[1, -2, 0]",
         "lights[4].up: the light's direction is parallel to \"up\", which leaves its turn open; "
         "give another \"up\", such as [0, 0, 1] (at frame 3)"},
        {"/observer/up", "[0, 1, 0]", "observer.up", "[0, 1, 0]", "[0, -1, 0]",
         "observer.up: must not be zero, since it gives a direction (at frame 3)"},
        {"/models/block/parts/1/parts/0/scale", "1", "models.block.parts[1].parts[0].scale", "1",
         "-1",
         "models.block.parts[1].parts[0].scale: is singular: it flattens the object to nothing in "
         "one direction (at frame 3)"},
        {"/models/cut/cut/1/scale", "1", "models.cut.cut[1].scale", "[1, 1, 1]", "[1, -1, 1]",
         "models.cut.cut[1].scale: is singular: it flattens the object to nothing in one direction "
         "(at frame 3)"},
        {"/world/medium/density", R"({"kind": "grid", "file": "m.vdb", "scale": 1})",
         "world.medium.density.scale", "1", "-1",
         "world.medium.density.scale: is singular: it flattens the object to nothing in one "
         "direction (at frame 3)"},
    };
    for (const Case& wrong : cases) {
        json scene = full_scene();
        scene[json::json_pointer(wrong.part)] = json::parse(wrong.value);
        scene["animation"]["tracks"] = {{{"target", wrong.target},
                                         {"keys",
                                          {{{"frame", 1}, {"value", json::parse(wrong.from)}},
                                           {{"frame", 5}, {"value", json::parse(wrong.to)}}}}}};
        const Scene read = parse(scene);
        const Error error = error_of([&] { scene_at(read, 3); });
        EXPECT_EQ(error.kind(), ErrorKind::scene);
        EXPECT_THAT(error.what(), testing::StartsWith("s.json:1:"));
        EXPECT_THAT(error.what(), testing::EndsWith(std::string(": ") + wrong.message));
    }
}

TEST_F(SceneFrames, WhoseLengthsCrossNameTheValueThatIsTooLarge) {
    struct Case {
        const char* part;
        const char* value;
        const char* smaller;  ///< grows to 1.9 at once at frame 5
        const char* larger;   ///< from 0.5 to 1.5
        const char* message;
    };
    const Case cases[] = {
        {"/models/ring", R"({"shape": "torus", "radius": 2, "tube": 0.1})", "models.ring.radius",
         "models.ring.tube", "models.ring.tube: must not be larger than the torus's radius"},
        {"/world/medium/density",
         R"({"kind": "ball", "center": [0, 0, 0], "radius": 2, "falloff": 0.1})",
         "world.medium.density.radius", "world.medium.density.falloff",
         "world.medium.density.falloff: must not be larger than the radius, 0.9"},
        {"/lights/1/angle", "50", "lights[1].angle", "lights[1].inner_angle",
         "lights[1].inner_angle: must not be larger than the spot's angle"},
        {"/observer/display", R"({"shape": "pyramid", "near": 0.1, "far": 3})",
         "observer.display.far", "observer.display.near",
         "observer.display.far: nothing lies between near, 1 m, and far, 0.9 m"},
    };
    for (const Case& wrong : cases) {
        json scene = full_scene();
        scene[json::json_pointer(wrong.part)] = json::parse(wrong.value);
        const auto key = [](double frame, double value) {
            return json{{"frame", frame}, {"value", value}};
        };
        scene["animation"]["tracks"] = {
            {{"target", wrong.smaller},
             {"interpolation", "step"},
             {"keys", {key(1, 0.9), key(5, 1.9)}}},
            {{"target", wrong.larger}, {"keys", {key(1, 0.5), key(5, 1.5)}}}};
        const Scene read = parse(scene);
        EXPECT_NO_THROW(scene_at(read, 2)) << wrong.smaller;
        const Error error = error_of([&] { scene_at(read, 3); });
        EXPECT_EQ(error.kind(), ErrorKind::scene);
        EXPECT_THAT(error.what(), testing::StartsWith("s.json:1:"));
        EXPECT_THAT(error.what(),
                    testing::EndsWith(std::string(": ") + wrong.message + " (at frame 3)"));
    }
}

}  // namespace voxelume
