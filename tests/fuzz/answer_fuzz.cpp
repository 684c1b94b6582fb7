// SPDX-License-Identifier: Apache-2.0
// A libFuzzer target: whatever a helper program answers gives what is valid, or an error. Formats
// are the answers of voxelume-image-decoder (image), voxelume-mesh-decoder (mesh) and
// voxelume-vdb-reader (grid). The first byte chooses the question; what follows is the answer. No
// helper is started.
#include <cstring>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/base/helper/helper_process.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/picture.hpp"
#include "runtime/io/image_codec/image_codec.hpp"
#include "runtime/io/mesh_codec/mesh_codec.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/vdb/vdb_density.hpp"
#include "runtime/io/volume_file.hpp"
#include "tests/fuzz/fuzz_file.hpp"
#include "tests/fuzz/refusals.hpp"
#include "tests/support/voxel_invariants.hpp"

namespace voxelume {
namespace {

std::span<const uint8_t> left;  ///< of the answer

}  // namespace

HelperProcess::HelperProcess(const std::filesystem::path&, const std::vector<std::string>&, int,
                             double seconds)
    : seconds_(seconds) {}
HelperProcess::~HelperProcess() = default;

size_t HelperProcess::read(void* data, size_t size) {
    if (left.empty()) throw HelperFailure(HelperFailure::Cause::died, "it has ended");
    const auto taken = left.first(std::min(size, left.size()));
    left = left.subspan(taken.size());
    std::memcpy(data, taken.data(), taken.size());
    return taken.size();
}

namespace {

constexpr uint32_t kMaxSamples = 4;

void check(bool is_right, const char* what) {
    if (!is_right) fail_fuzzing("wrong after an answer", what);
}

void check_picture(const Picture& picture) {
    check(picture.pixels.size() == size_t(picture.width) * size_t(picture.height), "pixels");
}

void check_exr_image(const std::filesystem::path& file) {
    const Image image = read_exr(file);
    for (const auto& [name, plane] : image.planes)
        check(plane.size() == size_t(image.width) * size_t(image.height), "rows of a channel");
}

void check_deep_rows(const InputFile& file) {
    const DeepExrHeader header = ask_deep_exr_header(file);
    ask_deep_exr(file, header.size, kMaxSamples, [&](int, const DeepExrRow& row) {
        check(row.counts.size() == size_t(header.size.x), "counts of samples");
        check(row.samples() <= uint64_t{kMaxSamples} * row.counts.size(), "samples");
    });
}

void check_pngs(uint8_t choice, std::span<const uint8_t> bytes, const std::filesystem::path& name) {
    constexpr uint64_t kMaxPixels = 1 << 20;
    if (choice == 0) return check_picture(parse_png(bytes, name, kMaxPixels));
    const std::array<std::span<const uint8_t>, 2> two = {bytes, bytes};
    for (const Picture& picture : parse_pngs(two, name, kMaxPixels)) check_picture(picture);
}

void check_slices(const InputFile& file) {
    const PngShape shape = ask_png_shape(file);
    if (shape.bytes() > (1 << 24)) return;
    const std::vector<std::vector<uint8_t>> pngs(2);
    const std::vector<std::filesystem::path> names(2, file.path());
    check(ask_png_values(pngs, names, shape).size() == 2 * shape.bytes(), "numbers of slices");
}

void ask_about_image(uint8_t choice, const std::filesystem::path& file) {
    const uint8_t bytes[] = {1, 2, 3};
    switch (choice % 8) {
        case 0:
            read_exr_header(file);
            return;
        case 1:
            return check_exr_image(file);
        case 2:
            return check_deep_rows(InputFile(file));
        case 3:
            read_volume(file);
            return;
        case 4:
            return check_picture(parse_jpeg(bytes, file));
        case 5:
            return check_slices(InputFile(file));
        default:
            return check_pngs(choice % 8 - 6, bytes, file);
    }
}

void ask_about_mesh(uint8_t choice, const std::filesystem::path& file) {
    const std::vector<uint8_t> bytes(16);
    CodecJob job{{}, bytes, "a mesh"};
    CodecTask& task = job.task;
    task.codec = MeshCodec(choice % 4);
    task.count = 3;
    task.stride = 4;
    task.indices = 6;
    task.attribute_count = 2;
    task.attributes[0] = {0, 5126, 3};
    task.attributes[1] = {1, 5121, 4};
    const std::vector<CodecArrays> results = decode_meshes(file, std::vector(2, job));
    check(results.size() == 2, "results");
    for (const CodecArrays& arrays : results) {
        const bool is_draco = task.codec == MeshCodec::draco;
        check(arrays.size() == (is_draco ? 3 : 1), "arrays");
        check(is_draco ? arrays[0].size() <= 24 : arrays[0].size() == 12, "values");
        check(!is_draco || (arrays[1].size() == 36 && arrays[2].size() == 12), "attributes");
    }
}

void ask_about_grid(uint8_t choice, const std::filesystem::path& file) {
    if (choice % 5 == 0) {
        read_vdb_summary(file);
    } else if (choice % 5 == 1) {
        const auto density = read_vdb_density({.file = file, .grid = "density"});
        std::vector<float> values(4096);
        density->sample(glm::dvec3(-1), glm::dvec3(0.25), std::span<float, 4096>(values));
        density->constant_in({glm::vec3(-1), glm::vec3(3)});
        check(std::ranges::all_of(values, [](float value) { return std::isfinite(value); }),
              "densities");
    } else if (choice % 5 == 4) {
        read_volume(file);
    } else {
        const Surface surface = choice % 5 == 2 ? Surface::cubes : Surface::smooth;
        const std::string broken = broken_invariant(read_voxel_model(file, surface, 0, {}));
        if (!broken.empty()) fail_fuzzing("invalid model", broken);
    }
}

/// A file whose readers ask a helper about it.
std::filesystem::path asked_file() {
    std::filesystem::path file = fuzz_file();
    if (fuzzes("image")) {
        decode_images({true, "none", 1});
        file += ".exr";
        Image image;
        image.width = image.height = 1;
        for (const char* name : {"R", "G", "B"}) image.planes[name] = std::vector<float>(1);
        write_exr(file, image);
    } else {
        file += ".vdb";
        const uint8_t start[] = {' ', 'B', 'D', 'V', 0, 0, 0, 0};
        write_bytes(file, start);
    }
    return file;
}

}  // namespace
}  // namespace voxelume

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace voxelume;
    static const std::filesystem::path file = asked_file();
    if (size == 0) return 0;
    const auto ask = fuzzes("image")  ? ask_about_image
                     : fuzzes("mesh") ? ask_about_mesh
                                      : ask_about_grid;
    left = {data + 1, size - 1};
    try {
        ask(data[0], file);
    } catch (const Error&) {  // with a sentence of the helper's, too
    }
    return 0;
}
