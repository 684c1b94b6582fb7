// SPDX-License-Identifier: Apache-2.0
// Volumetric images: their voxels in memory, their files, and views of them.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "image.hpp"
#include "observer.hpp"
#include "scene.hpp"
#include "values.hpp"

namespace voxelume::v1 {

/// The content of a voxel of a display.
enum class VoxelKind : uint8_t {
    space,   ///< the medium
    object,  ///< a surface
    unseen   ///< space behind a surface; rendering lists none
};

/// The file formats of volumetric images; scenes/VOLUMES.md describes them.
enum class VolumeFormat {
    vdb,           ///< .vdb: OpenVDB
    exr,           ///< .exr: deep OpenEXR; layout `rays`
    nrrd,          ///< .nrrd: dense RGBA
    raw,           ///< .raw and .json: dense arrays and a header
    slices,        ///< name.####.png: a PNG per slice, and name.json
    ply,           ///< .ply: points in the world
    kv6,           ///< .kv6: voxels of Voxlap and Slab6; layout `lattice`
    planes,        ///< .planes: one bit a voxel, for swept projectors; layout `lattice`
    color_planes,  ///< .cplanes: three bits a voxel; layout `lattice`
    rgb332,        ///< .rgb332: a byte a voxel of a turning display; layout `lattice`
    rgb565         ///< .rgb565: two bytes a voxel of a turning display; layout `lattice`
};

/// The format that a file's ending stands for. Throws Error::usage with the endings there are.
VolumeFormat volume_format_of(const std::filesystem::path& file);
/// The format of a name: "vdb", "color-planes", ... Throws Error::usage with the nearest name.
VolumeFormat volume_format_named(std::string_view name);
/// The names of all formats, in the order of VolumeFormat.
std::span<const std::string_view> volume_format_names();

/// The conversion of light to the few levels of a display's voxel.
enum class Dither {
    none,   ///< the nearest level
    bayer8  ///< ordered: 8 x 8 thresholds, shifted from plane to plane
};

/// An axis of the observer.
enum class Axis { x, y, z };

/// The options of a volumetric image's file.
struct VolumeFileOptions {
    std::optional<VolumeFormat> format{};  ///< format; without it the name's ending says it
    bool compress = true;                  ///< NRRD: gzip instead of raw
    bool all_values = false;               ///< NRRD: depth, object and kind, with RGBA
    // The options of displays' own formats:
    double exposure = 0;             ///< stops: colours are multiplied by 2^exposure
    Dither dither = Dither::bayer8;  ///< dithering of displays' formats
    Axis sweep = Axis::y;            ///< axis along which planes are swept
    int angles = 0;                  ///< angles of cylinders; 0: as many as the outer voxels need
    int radii = 0;                   ///< radii of cylinders; 0: half of the shorter side
};

/// The positions of a volumetric image's voxels.
struct VolumeFrame {
    VolumeLayout layout = VolumeLayout::lattice;  ///< meaning of its voxels' axes
    std::array<int, 3> size{};                    ///< voxels along the three axes of the layout
    /// Metres of the observer's coordinates. In a lattice, voxel (i, j, k) fills
    /// origin + edge * [(i, j, k), (i, j, k) + 1].
    Vec3 origin{};
    Vec3 edge{};                   ///< metres, along the same axes
    double near = 0;               ///< rays: voxel k of a ray spans near + step * [k, k + 1] metres
    double step = 0;               ///< metres, of the layout rays
    Matrix world_from_observer{};  ///< 4 x 4
};

/// From where a volumetric image is looked at; 0, 0 is the observer's side.
struct ViewPoint {
    double around = 35;  ///< degrees about the display's middle, to the observer's right
    double above = 25;   ///< degrees, -90..90
};

/// A volumetric image: sparse voxels, as arrays of equal length in ascending order of `indices`.
/// Whatever isn't listed is space that shows nothing. Copies share the arrays, which never change.
class Volume {
  public:
    /// Reads a .vdb, .exr, .nrrd or .raw/.json file that Voxelume wrote. Throws Error::input for a
    /// file that is missing, damaged or none of these, Error::usage for formats that aren't read.
    static Volume read(const std::filesystem::path& file);

    /// The positions of the volume's voxels in the world.
    const VolumeFrame& frame() const;
    size_t count() const;  ///< number of the voxels that are listed

    // The arrays live as long as this volume or a copy of it.
    std::span<const uint64_t> indices() const;     ///< i + size[0] * (j + size[1] * k)
    std::span<const float> colors() const;         ///< R, G, B of each voxel; linear Rec. 709,
                                                   ///< not multiplied by the opacity
    std::span<const float> opacities() const;      ///< 0..1
    std::span<const float> depths() const;         ///< metres from the observer
    std::span<const uint32_t> object_ids() const;  ///< numbers of objects, from 1; 0: no object
    /// The content of each voxel.
    std::span<const VoxelKind> kinds() const;

    /// Writes a file by the format of its ending. Each file appears whole or not at all, and the
    /// same volume gives the same bytes. Throws Error::usage for a layout that the format can't
    /// hold, Error::limit for sizes beyond the format or 64 GiB of dense voxels, Error::output.
    void write(const std::filesystem::path& file, const VolumeFileOptions& options = {}) const;

    /// The front and the view from `from` side by side, below them eight slices from near to far.
    /// Throws Error::usage for a size below 64 pixels a side.
    Image view(ViewPoint from = {}, Size size = {1280, 1000}) const;

    /// Writes a page that shows the volume in a browser, to be turned and sliced with the mouse;
    /// `exposure` is in stops. Throws Error::output.
    void write_page(const std::filesystem::path& file, ViewPoint from = {},
                    double exposure = 0) const;

    struct Implementation;
    /// For the library's own use.
    explicit Volume(std::shared_ptr<const Implementation> implementation)
        : implementation_(std::move(implementation)) {}
    /// For the library's own use.
    const Implementation& implementation() const { return *implementation_; }

  private:
    std::shared_ptr<const Implementation> implementation_;
};

/// The files of a volumetric image that was written under this name: some formats have a header of
/// their own, and slices are a file each. Empty unless all of them are there.
std::vector<std::filesystem::path> volume_files(const std::filesystem::path& file);

/// The files that are there and that writing a volumetric image under this name may replace.
std::vector<std::filesystem::path> replaced_files(const std::filesystem::path& file);

/// Throws what writing any volumetric image of the scene to this file would throw, before there is
/// one: Error::usage, Error::limit and Error::output as Volume::write does.
void check_volume_file(const std::filesystem::path& file, const Scene& scene);

}  // namespace voxelume::v1
