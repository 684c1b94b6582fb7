// SPDX-License-Identifier: Apache-2.0
// Measures how far rendered surfaces lie from their mesh: bench_accuracy [MESH-FILE [VOXELS [WIDTH
// HEIGHT]]].
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "runtime/io/mesh/mesh_reader.hpp"
#include "tests/support/accuracy_fixture.hpp"

namespace voxelume {
namespace {

constexpr ShownSurface kChoices[] = {{"cubes, supercover", Surface::cubes, VoxelSet::supercover},
                                     {"cubes, thin", Surface::cubes, VoxelSet::thin},
                                     {"cubes, solid", Surface::cubes, VoxelSet::solid},
                                     {"smooth", Surface::smooth},
                                     {"exact", Surface::exact}};

struct Arguments {
    std::filesystem::path file = "/usr/share/glmark2/models/bunny.obj";
    int resolution = 512;
    glm::ivec2 size{1024, 1024};
};

Arguments parse(int argc, char** argv) {
    Arguments a;
    if (argc > 1) a.file = argv[1];
    if (argc > 2) a.resolution = std::atoi(argv[2]);
    if (argc > 4) a.size = {std::atoi(argv[3]), std::atoi(argv[4])};
    return a;
}

void print(const char* name, const SurfaceErrors& e) {
    fmt::print(
        "{:<17} {:>7.5f} {:>8.5f}   {:>8.6f} {:>8.5f} {:>9.4f}   {:>6} {:>8.5f} % {:>6} {:>6}\n",
        name, e.distance_rms, e.distance_max, e.along_median, e.along_99, e.along_max,
        e.mask_differs, 100 * e.mask_share(), e.holes, e.mask_differs_clear);
    std::fflush(stdout);
}

void measure(const Arguments& a) {
    const Device device = Device::open();
    const Mesh mesh = read_mesh(a.file);
    const oracle::MeshTree tree(triangles_of(mesh));
    fmt::print(
        "{}: {} triangles, {} voxels along the longest side, {} x {} pixels, {} lanes on {}\n"
        "in voxels: distance of P to the mesh, difference along the ray; pixels whose mask "
        "differs,\nof these holes, and those farther than 0.001 voxel from a silhouette edge\n"
        "{:<17} {:>7} {:>8}   {:>8} {:>8} {:>9}   {:>6} {:>10} {:>6} {:>6}\n",
        a.file.filename().string(), mesh.triangles.size(), a.resolution, a.size.x, a.size.y,
        device.lanes(), device.info().name, "surface", "rms", "max", "median", "99 %", "max",
        "mask", "share", "holes", "clear");
    for (const ShownSurface& choice : kChoices) {
        const Scene scene = mesh_scene(a.file, mesh, choice, a.resolution, a.size);
        RenderReport report;
        print(choice.name, measure_surface(scene, render(device, scene, report), tree));
    }
}

}  // namespace
}  // namespace voxelume

int main(int argc, char** argv) {
    try {
        voxelume::measure(voxelume::parse(argc, argv));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_accuracy: %s\n", error.what());
        return 1;
    }
}
