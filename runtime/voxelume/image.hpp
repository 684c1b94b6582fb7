// SPDX-License-Identifier: Apache-2.0
// Flat images: their channels in memory, and their files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "values.hpp"

namespace voxelume::v1 {

/// The channels of an image. Channels that aren't asked for aren't computed.
struct Channels {
    bool color = true;            ///< R G B A
    bool depth = true;            ///< Z
    bool position = true;         ///< P.X P.Y P.Z
    bool normal = true;           ///< N.X N.Y N.Z
    bool object = true;           ///< objectId
    bool distance = false;        ///< distance
    bool material = false;        ///< materialId
    bool object_matte = false;    ///< Cryptomatte of the objects: CryptoObject00 to CryptoObject02
    bool material_matte = false;  ///< ... of the materials: CryptoMaterial00 to CryptoMaterial02
    // Each of these is lit once more, or several times:
    bool albedo = false;        ///< albedo.R ...: the surface's own colour
    bool direct = false;        ///< direct.R ...: light that comes straight to the first surface
    bool indirect = false;      ///< indirect.R ...: all other light
    bool shadow = false;        ///< shadow.R ...: the part of the direct light that is hidden
    bool light_groups = false;  ///< light_GROUP.R ... of each group of lights, and light_rest.R ...
    /// forward.u, forward.v: the movement of a pixel's point until the next frame, in pixels to the
    /// right and up; backward.u, backward.v: the way back to its position a frame before.
    bool motion = false;
    bool samples = false;  ///< samples: the number of each pixel's samples
    /// noise: the standard error of the light of each 4 x 4 pixels over its mean, as
    /// Scene::with_noise measures it; +infinity where it isn't measured.
    bool noise = false;
    /// variance.R, variance.G, variance.B: the variance of each pixel's mean, as if its samples
    /// were independent; +infinity for a pixel of one sample.
    bool variance = false;

    /// True if both have the same.
    friend bool operator==(const Channels&, const Channels&) = default;
};

/// A group of channels that is asked for together.
struct ChannelRow {
    std::string_view name;   ///< name of the group: "RGBA", "CryptoObject"
    bool Channels::*member;  ///< member of Channels that asks for it
    /// Names of the channels in files; a name that ends in _ is a prefix.
    std::span<const char* const> planes;
};

/// All groups of channels, in reading order.
std::span<const ChannelRow> channel_table();

/// No channels at all.
inline constexpr Channels kNoChannels{false, false, false, false, false};

/// Colour alone: what a picture shows.
inline constexpr Channels kColorAlone{true, false, false, false, false};

/// The way in which light that is too bright for a screen becomes a colour of the screen.
enum class ViewTransform {
    srgb,    ///< the colour as it is, cut off at 1
    none,    ///< the colour as it is, stored linearly, for programs that expect light
    filmic,  ///< a curve like film's, each channel alone (Narkowicz 2015)
    agx      ///< a curve over 16.5 stops, after which bright colours are whiter (Sobotka 2022)
};

/// The options of an image's file.
struct ImageFileOptions {
    double exposure = 0;  ///< PNG: stops; colours are multiplied by 2^exposure
    ViewTransform view_transform = ViewTransform::srgb;  ///< PNG: how light becomes colour
    int png_bits = 8;                                    ///< PNG: bits a channel, 8 or 16
    bool float_color = false;  ///< OpenEXR: colour as 32-bit floats, not halves
    Channels channels{};       ///< OpenEXR: those of the image's channels that are written
    bool multi_part = false;   ///< OpenEXR: each layer as a part of its own, named as the layer
};

/// An image: planes of width x height values, row 0 at the top, x fastest. Copies share the planes,
/// which never change.
///
/// Colour is linear Rec. 709 and multiplied by A. Z is the depth along the observer's axis in
/// metres; in displays that look backwards, it is the distance. `distance` counts along the sight
/// ray, P is the point and N the normal in the world. Pixels that show no object have Z = distance
/// = +infinity, P = N = 0 and objectId 0; objects count from 1 in the order of the scene, and so do
/// materials, after `default`, which is 1.
class Image {
  public:
    /// Reads an OpenEXR file with all of its channels, or a PNG file, whose R G B A become codes
    /// over 255 (`holds_codes`). If an OpenEXR file has several parts, it reads the first and all
    /// flat ones with the same data window. Throws Error::input.
    static Image read(const std::filesystem::path& file);

    /// Number of pixels in a row.
    int width() const;
    /// Number of rows.
    int height() const;
    bool holds_codes() const;  ///< values are sRGB codes of a PNG file, not light

    /// The names of the float channels in alphabetical order: "A", "B", "G", "N.X", ...
    std::vector<std::string> channels() const;
    /// True if the image has a channel of this name, such as "R" or "N.X".
    bool has(std::string_view channel) const;

    /// The plane of a float channel. It lives as long as this image or a copy of it. Throws
    /// Error::usage for a channel that the image doesn't have.
    std::span<const float> plane(std::string_view channel) const;
    /// The numbers of the objects; empty if they weren't asked for.
    std::span<const uint32_t> object_ids() const;
    /// The numbers of the materials; empty if they weren't asked for.
    std::span<const uint32_t> material_ids() const;

    /// Copies a plane to the caller's memory, whose size must be the number of values. Throws
    /// Error::usage for another size.
    void copy(std::string_view channel, std::span<float> to) const;

    /// Writes an OpenEXR or PNG file, by the ending of its name. The file appears whole or not at
    /// all, and the same image gives the same bytes. Throws Error::usage for another ending,
    /// Error::output.
    void write(const std::filesystem::path& file, const ImageFileOptions& options = {}) const;

    /// The bytes of the file that `write` would write under a name with this ending, such as
    /// ".png".
    std::string encode(std::string_view ending, const ImageFileOptions& options = {}) const;

    struct Implementation;
    /// For the library's own use.
    explicit Image(std::shared_ptr<const Implementation> implementation)
        : implementation_(std::move(implementation)) {}
    /// For the library's own use.
    const Implementation& implementation() const { return *implementation_; }

  private:
    std::shared_ptr<const Implementation> implementation_;
};

/// A format of image files.
struct ImageFormat {
    std::string_view ending;  ///< ending of names: ".exr"
    /// Every channel is held as it is; otherwise colours for a screen.
    bool holds_channels = false;
};

/// The formats that Image::write writes.
std::span<const ImageFormat> image_formats();

/// The difference of a channel from that of a reference.
struct ChannelDifference {
    std::string channel{};   ///< its name
    double max = 0;          ///< largest |a - b|
    double rmse = 0;         ///< root of the mean of (a - b)^2
    double mae = 0;          ///< mean of |a - b|
    double mrse = 0;         ///< mean of ((a - b) / (|b| + 0.01))^2
    uint64_t differing = 0;  ///< pixels whose values are unequal
    uint64_t unmatched = 0;  ///< pixels of these with a value that isn't finite; in no mean
    uint64_t above = 0;      ///< pixels above the threshold, with the unmatched ones; numbers of
                             ///< objects: unequal ones
    bool is_id = false;      ///< true for ids, those of Cryptomatte among them: values are equal or
                             ///< unequal, without distance
};

/// The differences between two images.
struct ImageDifference {
    /// Differences by name; numbers of objects come last.
    std::vector<ChannelDifference> channels{};
    std::vector<std::string> only_in_a{};  ///< channels that the second image lacks
    std::vector<std::string> only_in_b{};  ///< channels that the first image lacks
    /// Mean FLIP (Andersson et al. 2020, LDR), if both have colours, all are numbers, and memory
    /// has room for 200 bytes a pixel.
    std::optional<double> flip;
    uint64_t pixels = 0;  ///< pixels of each image
    uint64_t above = 0;   ///< pixels above the threshold in some channel that both have
};

/// Selects the differences that count.
struct CompareOptions {
    std::vector<std::string> channels{};  ///< these alone, and FLIP with R, G and B; empty: all
    double threshold = 0;                 ///< |a - b| up to this isn't above it
};

/// Compares `a` with the reference `b`. Throws Error::render for images of different sizes,
/// Error::usage where one holds codes and the other light, and for channels that neither has.
ImageDifference compare(const Image& a, const Image& b, const CompareOptions& options = {});

/// A picture of |a - b|, channel by channel; 65504 where a value isn't finite. For images that hold
/// codes, the result is an image whose codes in a PNG file are the differences of theirs. Throws as
/// `compare`.
Image difference_image(const Image& a, const Image& b, const CompareOptions& options = {});

/// A picture of FLIP: a channel FLIP, 0..1, and as R, G, B a scale of heat from black, for what
/// looks equal, over red and yellow to white. Throws as `compare`, and Error::usage for images
/// without colours.
Image flip_image(const Image& a, const Image& b);

}  // namespace voxelume::v1
