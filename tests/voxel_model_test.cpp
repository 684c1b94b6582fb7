// Models whose voxels come from files, and voxels with an opacity of their own.
#include "runtime/voxel_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/error.hpp"
#include "runtime/illumination.hpp"
#include "runtime/io/vdb.hpp"
#include "runtime/model_frame.hpp"
#include "runtime/renderer.hpp"
#include "runtime/stages/voxelize.hpp"
#include "runtime/voxel_export.hpp"
#include "tests/file_fixture.hpp"
#include "tests/test_device.hpp"

namespace voxelume {
namespace {

constexpr const char* kColors[] = {"R", "G", "B"};
constexpr const char* kObj =
    "v 0 0 0\nv 1 0 0\nv 0 0.7 0\nv 0 0 0.5\nusemtl a\nf 1 3 2\nf 1 2 4\nusemtl b\nf 2 3 4\nf 3 1 "
    "4\n";

class VoxelModels : public FileTest {
  protected:
    Image rendered(const std::string& model, const std::string& materials,
                   const std::string& more = "") const {
        const std::string text = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-0.5, -0.5, -0.5], "max": [1.5, 1, 1]},
          "background": [0.25, 0.5, 0.75], "ambient": [0.1, 0.2, 0.3]},
"materials": {"m": {}, "n": {"color": [0.2, 0.9, 0.3]})" +
                                 materials + R"(},
"models": {"thing": )" + model + R"(},
"objects": [{"model": "thing", "material": "m", "turn": [0, 0, 0]})" +
                                 more + R"(],
"lights": [{"type": "directional", "direction": [0.3, -1, 0.4]}],
"observer": {"position": [1.2, 1, -2], "look_at": [0.3, 0.2, 0.2],
             "display": {"shape": "pyramid", "angle": 30}},
"render": {"size": [48, 36]}})";
        RenderReport report;
        return render(test_device(), parse_scene(text, folder / "s.json", {}), report);
    }

    void voxelize_to(const std::string& name, Surface surface) const {
        put_bytes(folder / "m.obj", kObj);
        const Device device = test_device();
        MeshStore meshes;
        const Mesh& mesh = meshes.mesh(folder / "m.obj");
        Model model;
        model.voxel_size = glm::dvec3(0.05);
        model.surface = surface;
        const BrickGrid grid = Voxelizer(device).voxelize(
            mesh, glm::dmat4(1), model_frame(model, &mesh), {surface, VoxelSet::supercover});
        const VoxelExport exported(grid, mesh, surface, VoxelSet::supercover);
        exported.write_model(folder / (name + ".vxm"));
        exported.write_vdb(folder / (name + ".vdb"));
    }

    void expect_refused(const std::string& name, Surface surface, const std::string& part) const {
        try {
            read_voxel_model(folder / name, surface);
            ADD_FAILURE() << name << " is accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
            EXPECT_THAT(error.what(), testing::HasSubstr(part));
        }
    }
};

TEST_F(VoxelModels, OfAModelFileRenderAsTheirMeshToTheBit) {
    for (const auto& [surface, name] : {std::pair{Surface::cubes, "cubes"},
                                        {Surface::smooth, "smooth"},
                                        {Surface::exact, "exact"}}) {
        voxelize_to(name, surface);
        const std::string as = std::string(R"(, "surface": ")") + name + "\"}";
        const Image mesh = rendered(R"({"mesh": "m.obj", "voxel_size": 0.05)" + as, "");
        const Image voxels = rendered(std::string(R"({"voxels": ")") + name + ".vxm\"" + as, "");
        for (const char* color : kColors) {
            if (surface != Surface::exact) {
                EXPECT_EQ(mesh.planes.at(color), voxels.planes.at(color)) << name;
                continue;
            }
            for (size_t i = 0; i < mesh.planes.at(color).size(); ++i)
                EXPECT_NEAR(mesh.planes.at(color)[i], voxels.planes.at(color)[i], 1e-3) << i;
        }
    }
}

TEST_F(VoxelModels, OfOpenVdbRenderAsTheirMesh) {
    for (const auto& [surface, name] :
         {std::pair{Surface::cubes, "cubes"}, {Surface::smooth, "smooth"}}) {
        voxelize_to(name, surface);
        const std::string as = std::string(R"(, "surface": ")") + name + "\"}";
        const Image mesh = rendered(R"({"mesh": "m.obj", "voxel_size": 0.05)" + as, "");
        const Image voxels = rendered(std::string(R"({"voxels": ")") + name + ".vdb\"" + as, "");
        size_t different = 0;
        for (size_t i = 0; i < mesh.planes.at("R").size(); ++i)
            different += std::abs(mesh.planes.at("R")[i] - voxels.planes.at("R")[i]) > 1e-3f;
        EXPECT_LE(different, surface == Surface::cubes ? 0u : 3u) << name;
    }
}

TEST_F(VoxelModels, ThatAreDamagedOrAnotherSurfaceAreRefusedInOneSentence) {
    voxelize_to("a", Surface::cubes);
    const std::string bytes = bytes_of(folder / "a.vxm"), vdb = bytes_of(folder / "a.vdb");
    put_bytes(folder / "b.vxm", bytes.substr(0, bytes.size() / 2));
    put_bytes(folder / "b.vdb", vdb.substr(0, vdb.size() / 2));
    put_bytes(folder / "c.vxm", "solid");
    expect_refused("a.vxm", Surface::smooth, "\"surface\": \"cubes\"");
    expect_refused("b.vxm", Surface::cubes, "truncated");
    expect_refused("a.vdb", Surface::smooth, "has no level set");
    expect_refused("a.vdb", Surface::exact, "no exact surface");
    expect_refused("b.vdb", Surface::cubes, "not a readable OpenVDB file");
    expect_refused("c.vxm", Surface::cubes, "neither a .vxm nor an OpenVDB file");
    expect_refused("d.vxm", Surface::cubes, "d.vxm");
    for (size_t i = 0; i < bytes.size(); i += 97) {
        std::string changed = bytes;
        changed[i] = char(changed[i] ^ 0x41);
        put_bytes(folder / "e.vxm", changed);
        try {
            read_voxel_model(folder / "e.vxm", Surface::cubes);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input) << i;
        }
    }
}

TEST_F(VoxelModels, OfOpenVdbThatAreDamagedAnywhereAreRefusedOrRead) {
    // OpenVDB's reader itself corrupts memory on some of these.
    voxelize_to("a", Surface::cubes);
    const std::string bytes = bytes_of(folder / "a.vdb");
    size_t refused = 0;
    for (size_t i = 0; i < bytes.size(); i += bytes.size() / 80) {
        std::string changed = bytes;
        changed[i] = char(changed[i] ^ 0x41);
        put_bytes(folder / "b.vdb", changed);
        try {
            read_voxel_model(folder / "b.vdb", Surface::cubes);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input) << i;
            ++refused;
        }
    }
    EXPECT_GT(refused, 20u);
}

TEST_F(VoxelModels, ThatSpanTooMuchAreRefusedBeforeMemoryIsTaken) {
    const auto write = [&](const glm::ivec3& first, const glm::ivec3& last) {
        const std::vector<glm::ivec3> cells = {first, last};
        const std::vector<float> values = {1, 1};
        VdbVolume volume;
        volume.cells = cells;
        volume.values = values;
        write_vdb(folder / "far.vdb", volume);
    };
    write({0, 0, 0}, {1, 70000, 2});
    expect_refused("far.vdb", Surface::cubes, "span 10 x 70009 x 11");
    write({0, 0, 0}, {60000, 60000, 60000});
    expect_refused("far.vdb", Surface::cubes, "bricks of 16");
    write({2147483640, 0, 0}, {2147483646, 3, 4});
    expect_refused("far.vdb", Surface::cubes, "farther from its origin");
}

/// A stack along Z of plates, 12 x 9 voxels each, in a fog of their opacities and colours.
struct Stack {
    std::vector<float> opacities = {0.2f, 0.6f, 0.4f, 1.5f, 0.8f};
    std::vector<glm::vec3> colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 1, 1}};

    void write(const std::filesystem::path& path) const {
        std::vector<glm::ivec3> cells;
        std::vector<float> values;
        std::vector<glm::vec3> of_cells;
        for (int z = 0; z < int(opacities.size()); ++z)
            for (int y = 0; y < 9; ++y)
                for (int x = 0; x < 12; ++x) {
                    cells.emplace_back(x, y, z);
                    values.push_back(opacities[size_t(z)]);
                    of_cells.push_back(colors[size_t(z)]);
                }
        VdbVolume volume;
        volume.cells = cells;
        volume.values = values;
        volume.colors = of_cells;
        volume.voxel_edges = glm::dvec3(0.05);
        volume.origin = glm::dvec3(0.025);
        write_vdb(path, volume);
    }
    /// As the file's 8 bits keep it.
    double opacity(size_t plate) const {
        return std::round(255.0 * double(std::min(opacities[plate], 1.0f))) / 255;
    }
};

/// What a ray sees of voxels, of opacity and own light each, front to back.
struct Laid {
    double left = 1;
    double light[3] = {};

    void add(const Stack& stack, size_t plate, int voxels = 1) {
        for (int i = 0; i < voxels; ++i) {
            for (int c = 0; c < 3; ++c)
                light[c] += left * stack.opacity(plate) * 0.5 * stack.colors[plate][c];
            left *= 1 - stack.opacity(plate);
        }
    }
};

constexpr double kBackground[] = {0.25, 0.5, 0.75};

std::string stack_scene(const std::string& objects, const std::string& observer) {
    return R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-0.5, -0.5, -0.5], "max": [1.5, 1, 1]},
          "background": [0.25, 0.5, 0.75], "ambient": [1, 1, 1]},
"materials": {"m": {"color": [0.5, 0.5, 0.5]},
              "mirror": {"diffuse": 0, "reflection": 1}},
"models": {"stack": {"voxels": "stack.vdb"},
           "mirror": {"shape": "box", "size": [1, 0.9, 0.12], "surface": "cubes"}},
"objects": [)" +
           objects + R"(],
"observer": {)" +
           observer + R"(, "display": {"shape": "box", "size": [0.3, 0.2, 5]}},
"render": {"size": [6, 5]}})";
}

constexpr const char* kStack = R"({"model": "stack", "material": "m"})";
constexpr const char* kAlongZ = R"("position": [0.3, 0.22, -2], "look_at": [0.3, 0.22, 0])";

class StackedVoxels : public VoxelModels {
  protected:
    Image rendered_stack(const Stack& stack, const std::string& objects,
                         const std::string& observer = kAlongZ) const {
        stack.write(folder / "stack.vdb");
        RenderReport report;
        return render(test_device(),
                      parse_scene(stack_scene(objects, observer), folder / "s.json", {}), report);
    }

    static void expect_seen(const Image& image, const Laid& laid) {
        for (int c = 0; c < 3; ++c)
            for (const float value : image.planes.at(kColors[c]))
                EXPECT_NEAR(value, laid.light[c] + laid.left * kBackground[c], 2e-6) << c;
    }
};

TEST_F(StackedVoxels, CoverByTheirOwnOpacityFrontToBack) {
    Stack stack;
    for (const size_t plates : {5, 3}) {
        stack.opacities.resize(plates);
        const Image image = rendered_stack(stack, kStack);
        Laid laid;
        for (size_t plate = 0; plate < plates; ++plate) laid.add(stack, plate);
        expect_seen(image, laid);
        for (const float value : image.planes.at("A")) EXPECT_NEAR(value, 1 - laid.left, 2e-6);
    }
}

TEST_F(StackedVoxels, KeepOpacityAndColourWhenTurnedAndStretched) {
    // Turned so that the plates follow one another along X, each three voxels of the world deep.
    Stack stack;
    stack.opacities = {0.2f, 0.6f, 0.4f};
    const std::string placed =
        R"({"model": "stack", "material": "m", "position": [0.1, 0, 0.7], "turn": [90, 0, 0], "scale": [1, 1, 3]})";
    Laid forwards, backwards;
    for (size_t plate = 0; plate < 3; ++plate) {
        forwards.add(stack, plate, 3);
        backwards.add(stack, 2 - plate, 3);
    }
    expect_seen(
        rendered_stack(stack, placed, R"("position": [-2, 0.22, 0.4], "look_at": [0, 0.22, 0.4])"),
        forwards);
    expect_seen(
        rendered_stack(stack, placed, R"("position": [3, 0.22, 0.4], "look_at": [0, 0.22, 0.4])"),
        backwards);
}

TEST_F(StackedVoxels, CoverWhatAMirrorShowsToo) {
    Stack stack;
    stack.opacities = {0.2f, 0.6f, 0.4f};
    const Image image = rendered_stack(
        stack, std::string(kStack) +
                   R"(, {"model": "mirror", "material": "mirror", "position": [0.3, 0.2, 0.5]})");
    Laid laid;
    for (const size_t plate : {0, 1, 2, 2, 1, 0}) laid.add(stack, plate);
    expect_seen(image, laid);
}

TEST_F(StackedVoxels, OfWholeOpacityLeaveNothingOfItCompiled) {
    Stack stack;
    const Device device = test_device();
    const auto features = [&] {
        stack.write(folder / "stack.vdb");
        const Scene scene = parse_scene(stack_scene(kStack, kAlongZ), folder / "s.json", {});
        WorldReport report;
        return features_of(scene, form_world(device, scene, report));
    };
    const Features some = features();
    EXPECT_TRUE(some.voxel_opacity && some.transmission && some.paths && some.cube_bodies);
    stack.opacities.assign(5, 1.0f);
    const Features none = features();
    EXPECT_FALSE(none.voxel_opacity || none.transmission || none.paths || none.cube_bodies);
    EXPECT_TRUE(none.colors);
}

TEST_F(StackedVoxels, TintTheLightThatPassesThem) {
    Stack stack;
    stack.opacities.resize(3);
    stack.write(folder / "stack.vdb");
    // Light along Z through three plates onto a wall, seen from the side.
    const auto text = [](bool with_stack) {
        return std::string(R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -0.5, -0.5], "max": [1.5, 1, 1]}},
"materials": {"m": {}, "wall": {"color": [1, 1, 1]}},
"models": {"stack": {"voxels": "stack.vdb"},
           "wall": {"shape": "box", "size": [4, 4, 0.2], "surface": "cubes"}},
"objects": [{"model": "wall", "material": "wall", "position": [0.3, 0.2, 0.7]})") +
               (with_stack ? R"(, {"model": "stack", "material": "m"})" : "") + R"(],
"lights": [{"type": "directional", "direction": [0, 0, 1]}],
"observer": {"position": [-1.5, 0.22, 0.2], "look_at": [0.3, 0.22, 0.55],
             "display": {"shape": "pyramid", "angle": 2}},
"render": {"size": [6, 6]}})";
    };
    RenderReport report;
    const Image bare =
        render(test_device(), parse_scene(text(false), folder / "s.json", {}), report);
    const Image tinted =
        render(test_device(), parse_scene(text(true), folder / "s.json", {}), report);
    for (int c = 0; c < 3; ++c) {
        double passed = 1;
        for (size_t plate = 0; plate < 3; ++plate) {
            const double a = stack.opacity(plate), color = 0.8 * stack.colors[plate][c];
            passed *= (1 - a) * ((1 - a) + a * color);
        }
        for (size_t i = 0; i < 36; ++i) {
            ASSERT_GT(bare.planes.at(kColors[c])[i], 0.1f);
            EXPECT_NEAR(tinted.planes.at(kColors[c])[i], passed * bare.planes.at(kColors[c])[i],
                        1e-6);
        }
    }
}

}  // namespace
}  // namespace voxelume
