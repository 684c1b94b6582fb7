// SPDX-License-Identifier: Apache-2.0
// A user's program: builds a scene from plain structs, renders it flat and volumetric, and checks
// the results. It uses only what is installed of Voxelume.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>
#include <voxelume.hpp>

extern char** environ;

namespace {

using namespace voxelume;

int failures = 0;

void check(bool holds, const char* claim) {
    if (holds) return;
    std::fprintf(stderr, "consumer: it doesn't hold that %s\n", claim);
    ++failures;
}

/// A scene of a red ball that rises over a grey box, in front of the observer.
SceneDescription room() {
    SceneDescription room;
    room.name = "room";
    room.world = {.voxel_size = uniform(0.02),
                  .min = {-1, 0, -1},
                  .max = {1, 2, 1},
                  .background = {0, 0, 0.5},
                  .ambient = {0.25, 0.25, 0.25}};
    room.materials = {{.name = "red", .color = {0.8, 0, 0}},
                      {.name = "grey", .color = uniform(0.4)}};
    room.models = {{.name = "ball", .source = Sphere{0.3}},
                   {.name = "box", .source = Box{{1.2, 0.4, 0.8}}, .surface = Surface::exact}};
    room.objects = {{.name = "ball", .model = "ball", .material = "red", .position = {0, 0.9, 0}},
                    {.name = "box", .model = "box", .material = "grey", .position = {0, 0.2, 0}}};
    room.lights = {{.name = "lamp", .source = PointLight{{0.5, 1.8, 0.9}}, .intensity = 2}};
    room.observer = {.position = {0, 0.8, 3},
                     .look_at = Vec3{0, 0.8, 0},
                     .display = {.shape = PyramidDisplay{.angle = 44, .near = 1, .far = 5},
                                 .voxels = std::array{48, 36, 64}}};
    room.animation = {.frames = 3,
                      .tracks = {{.target = "objects.ball.position",
                                  .keys = Keys<Vec3>{{1, {0, 0.9, 0}}, {3, {0, 1.3, 0}}}}}};
    room.render = {.size = {64, 48}};
    return room;
}

/// The text of that scene as a file.
constexpr const char* kText = R"({"voxelume": 1,
"world": {"voxel_size": 0.02, "bounds": {"min": [-1, 0, -1], "max": [1, 2, 1]},
          "background": [0, 0, 0.5], "ambient": [0.25, 0.25, 0.25]},
"materials": {"red": {"color": [0.8, 0, 0]}, "grey": {"color": [0.4, 0.4, 0.4]}},
"models": {"ball": {"shape": "sphere", "radius": 0.3},
           "box": {"shape": "box", "size": [1.2, 0.4, 0.8], "surface": "exact"}},
"objects": [{"name": "ball", "model": "ball", "material": "red", "position": [0, 0.9, 0]},
            {"name": "box", "model": "box", "material": "grey", "position": [0, 0.2, 0]}],
"lights": [{"name": "lamp", "type": "point", "position": [0.5, 1.8, 0.9], "intensity": 2}],
"observer": {"position": [0, 0.8, 3], "look_at": [0, 0.8, 0],
             "display": {"shape": "pyramid", "angle": 44, "near": 1, "far": 5,
                         "voxels": [48, 36, 64]}},
"animation": {"frames": 3, "tracks": [{"target": "objects.ball.position",
    "keys": [{"frame": 1, "value": [0, 0.9, 0]}, {"frame": 3, "value": [0, 1.3, 0]}]}]},
"render": {"size": [64, 48]}})";

struct Pixel {
    float red, green, blue, depth;
    uint32_t object;
};

Pixel pixel(const Image& image, int x, int y) {
    const size_t i = size_t(y) * size_t(image.width()) + size_t(x);
    return {image.plane("R")[i], image.plane("G")[i], image.plane("B")[i], image.plane("Z")[i],
            image.object_ids()[i]};
}

bool is_same(const Image& a, const Image& b) {
    for (const std::string& name : a.channels()) {
        const auto p = a.plane(name), q = b.plane(name);
        if (p.size() != q.size() || std::memcmp(p.data(), q.data(), p.size_bytes()) != 0)
            return false;
    }
    return std::ranges::equal(a.object_ids(), b.object_ids());
}

void check_image(const Image& image) {
    check(image.width() == 64 && image.height() == 48, "the image is 64 x 48");
    const Pixel sky = pixel(image, 2, 2);
    check(sky.object == 0 && sky.blue == 0.5f && sky.red == 0, "the corner shows the background");
    check(std::isinf(sky.depth), "the background is at no depth");
    const Pixel ball = pixel(image, 32, 22);
    check(ball.object == 1, "the middle shows the first object");
    check(ball.red > 0.2f && ball.green == 0 && ball.blue == 0, "the ball is red");
    check(std::abs(ball.depth - 2.71f) < 0.03f, "the ball is 2.7 m away");
    const Pixel box = pixel(image, 32, 40);
    check(box.object == 2 && box.red > 0.1f && box.red == box.green, "below it the box is grey");
}

void check_volume(const Volume& volume) {
    check(volume.frame().size == std::array{48, 36, 64}, "the display has 48 x 36 x 64 voxels");
    check(volume.count() > 100 && volume.indices().size() == volume.count() &&
              volume.colors().size() == 3 * volume.count() &&
              volume.kinds().size() == volume.count(),
          "all arrays are as long as each other");
    check(std::ranges::is_sorted(volume.indices()), "indices ascend");
    const auto objects = volume.object_ids();
    check(std::ranges::count(objects, 1u) > 20 && std::ranges::count(objects, 2u) > 20,
          "both objects are in it");
    volume.write("room.vdb");
    check(Volume::read("room.vdb").count() == volume.count(), "OpenVDB files are read again");
}

void check_errors() {
    try {
        SceneDescription wrong = room();
        wrong.objects[1].material = "gray";
        Scene::build(wrong);
        check(false, "an unknown material is an error");
    } catch (const Error& error) {
        check(error.kind() == ErrorKind::scene && error.exit_code() == 3, "the scene is wrong");
        check(error.file() == "room" && error.line() == 0, "the scene's name is the file");
        check(error.key() == "objects[1].material", "the key is named");
        check(std::string(error.what()) ==
                  "room: objects[1].material: no material named \"gray\"; did you mean \"grey\"?",
              "the sentence says what to do");
    }
    try {
        Scene::parse("{\"voxelume\": 1,\n  \"wrold\": 2}", "text.json");
        check(false, "an unknown key is an error");
    } catch (const Error& error) {
        check(error.file() == "text.json" && error.line() == 2 && error.column() == 3,
              "file, line and column are named");
    }
}

void check_frames(const Scene& scene, const std::vector<Device>& devices) {
    FrameJob job;
    job.frames = {{.frame = 1}, {.frame = 3, .images = {"room.3.exr"}}};
    job.deliver_images = true;
    std::vector<int> delivered;
    std::vector<float> tops;
    job.deliver = [&](const RenderedFrame& rendered) {
        delivered.push_back(rendered.frame);
        const auto objects = rendered.image->object_ids();
        tops.push_back(float(std::ranges::find(objects, 1u) - objects.begin()));
    };
    double done = 0;
    RenderOptions options;
    options.progress = [&done](double now, int) { done = now; };
    const Statistics statistics = render_frames(scene, devices, job, options);
    check(delivered == std::vector{1, 3}, "frames come in order");
    check(tops.size() == 2 && tops[1] < tops[0], "the ball rises");
    check(done == 1, "progress ends with all");
    check(statistics.files == 1 && statistics.frames.size() == 2, "statistics count both frames");
    const Image file = Image::read("room.3.exr");
    check(file.width() == 64 && file.has("Z"), "the file has the image");
}

/// This is done without the variable that PoCL itself sets for its library of hardware locality.
std::vector<std::string> environment() {
    std::vector<std::string> variables;
    for (char** variable = environ; *variable; ++variable)
        if (!std::string_view(*variable).starts_with("HWLOC_")) variables.emplace_back(*variable);
    return variables;
}

int run() {
    const std::vector<std::string> before = environment();
    const Scene scene = Scene::build(room());
    check(scene.moves() && scene.frames() == 3, "the scene has three frames");
    const std::vector<Device> devices = {Device::open()};
    const Plan planned = plan(scene, devices[0]);
    check(planned.verdict == Verdict::fits && !planned.refusal, "so small a scene fits");
    const Image image = render_image(scene, devices);
    check_image(image);
    check(is_same(image, render_image(Scene::parse(kText), devices)),
          "structs and text give the same bits");
    check_volume(render_volume(scene, devices));
    check_frames(scene, devices);
    check_errors();
    check(environment() == before, "the environment is as it was");
    return failures == 0 ? 0 : 1;
}

}  // namespace

int main() {
    try {
        return run();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "consumer: %s\n", error.what());
        return 1;
    }
}
