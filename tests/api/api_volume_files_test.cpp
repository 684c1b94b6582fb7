// SPDX-License-Identifier: Apache-2.0
// Volumetric images from file to file, each of which is as it was written.
#include <gmock/gmock.h>

#include <map>
#include <string>
#include <vector>

#include "runtime/base/files/stamp.hpp"
#include "runtime/io/volume_file.hpp"
#include "runtime/voxelume/files.hpp"
#include "runtime/voxelume/volume.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/volume_samples.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAreArray;

class ApiVolumeFiles : public FileTest {
  protected:
    /// A volume as a rendered one: with a stamp, whose check is what an earlier file had.
    static Volume stamped(Volume volume) {
        volume.attributes["stamp"] =
            "voxelume-frame=0123456789abcdef0123456789abcdef check=fedcba9876543210";
        return volume;
    }

    /// The files with a volume of this name, headers first, then data or slices.
    std::vector<fs::path> files_of(const std::string& name) const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(folder))
            if (entry.path().filename().string().starts_with(name + "."))
                files.push_back(entry.path());
        return files;
    }

    static bool has_no_place(const fs::path& file) { return file.extension() == ".kv6"; }

    /// Writes a file of each format in `sources`, and each of them in each format in `targets`.
    void convert_each(const Volume& volume, const std::vector<std::string>& sources,
                      const std::vector<std::string>& targets) {
        VolumeOptions options;
        options.all_values = true;
        for (const std::string& source : sources) {
            const std::string from = "from_" + source.substr(1);
            write_volume(folder / (from + source), volume, options);
            const v1::Volume read = v1::Volume::read(folder / (from + source));
            for (const std::string& target : targets) convert(read, source, target);
            for (const fs::path& file : files_of(from))
                EXPECT_EQ(v1::verify_file(file), v1::FileIntegrity::whole) << file;
        }
    }

  private:
    void convert(const v1::Volume& volume, const std::string& source, const std::string& target) {
        SCOPED_TRACE(source + " to " + target);
        const std::string name = "to";
        for (const fs::path& file : files_of(name)) fs::remove(file);
        v1::VolumeFileOptions options;
        options.all_values = true;
        volume.write(folder / (name + target), options);
        for (const fs::path& file : files_of(name))
            EXPECT_EQ(v1::verify_file(file),
                      has_no_place(file) ? v1::FileIntegrity::unknown : v1::FileIntegrity::whole)
                << file;
        if (target == ".vdb" || target == ".exr" || target == ".nrrd" || target == ".raw") {
            const v1::Volume back = v1::Volume::read(folder / (name + target));
            EXPECT_THAT(back.indices(), ElementsAreArray(volume.indices()));
            if (target == ".exr") return;  // which multiplies colours by their opacities
            EXPECT_THAT(back.colors(), ElementsAreArray(volume.colors()));
        }
    }
};

TEST_F(ApiVolumeFiles, OfRaysAreWholeInEachFormatThatTheyAreConvertedTo) {
    convert_each(stamped(rays_volume()), {".vdb", ".exr", ".nrrd", ".raw"},
                 {".vdb", ".exr", ".nrrd", ".raw", ".##.png", ".ply"});
}

TEST_F(ApiVolumeFiles, OfALatticeAreWholeInEachFormatThatTheyAreConvertedTo) {
    convert_each(stamped(lattice_volume()), {".vdb", ".nrrd", ".raw"},
                 {".vdb", ".nrrd", ".raw", ".##.png", ".ply", ".kv6", ".planes", ".cplanes",
                  ".rgb332", ".rgb565"});
}

TEST_F(ApiVolumeFiles, InTwoFilesAreDamagedWhereABitOfEitherIsFlipped) {
    for (const std::string ending : {".raw", ".cplanes", ".rgb565"}) {
        const fs::path data = folder / ("v" + ending);
        write_volume(data, stamped(lattice_volume()));
        const fs::path header = folder / (ending == ".raw" ? "v.json" : "v" + ending + ".json");
        for (const fs::path& damaged : {data, header}) {
            const std::string bytes = bytes_of(damaged);
            for (size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 23) {
                std::string changed = bytes;
                changed[at] = char(changed[at] ^ 4);
                put_bytes(damaged, changed);
                EXPECT_NE(v1::verify_file(data), v1::FileIntegrity::whole) << damaged << at;
                EXPECT_NE(v1::verify_file(header), v1::FileIntegrity::whole) << damaged << at;
            }
            put_bytes(damaged, bytes);
        }
        put_bytes(data, bytes_of(data) + "x");
        EXPECT_EQ(v1::verify_file(data), v1::FileIntegrity::damaged);
    }
}

TEST_F(ApiVolumeFiles, WithoutAHeaderAreNotKnownToBeWhole) {
    write_volume(folder / "v.raw", lattice_volume());
    EXPECT_EQ(v1::verify_file(folder / "v.raw"), v1::FileIntegrity::whole);
    EXPECT_EQ(v1::verify_file(folder / "v.json"), v1::FileIntegrity::unknown);  // it has no stamp
    fs::rename(folder / "v.raw", folder / "w.raw");
    EXPECT_EQ(v1::verify_file(folder / "w.raw"), v1::FileIntegrity::unknown);
    fs::remove(folder / "v.json");
    EXPECT_EQ(v1::verify_file(folder / "w.raw"), v1::FileIntegrity::unknown);
}

TEST_F(ApiVolumeFiles, OfOpenVdbAreKnownByTheirIdentifiersToo) {
    const fs::path path = folder / "v.vdb";
    write_volume(path, lattice_volume());
    const std::string bytes = bytes_of(path);
    EXPECT_EQ(v1::verify_file(path), v1::FileIntegrity::whole);
    for (const size_t at : {size_t(25), bytes.size() / 2, bytes.size() - 1}) {
        std::string changed = bytes;
        changed[at] = char(changed[at] ^ 1);
        put_bytes(path, changed);
        EXPECT_EQ(v1::verify_file(path), v1::FileIntegrity::damaged) << at;
    }
    std::string others = bytes;
    others[21 + 14] = '4';  // a random identifier
    put_bytes(path, others);
    EXPECT_EQ(v1::verify_file(path), v1::FileIntegrity::unknown);
}

}  // namespace
}  // namespace voxelume
