// SPDX-License-Identifier: Apache-2.0
// The scene as plain values: names are indices, angles are radians, placements are matrices.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "runtime/scene/fitted.hpp"
#include "runtime/scene/parts/light.hpp"
#include "runtime/scene/parts/material.hpp"
#include "runtime/scene/parts/object.hpp"
#include "runtime/scene/parts/observer.hpp"
#include "runtime/scene/parts/reconstruction_filter.hpp"
#include "runtime/scene/parts/world.hpp"

namespace voxelume {

struct Image;

struct Animation {
    int frames = 1;   ///< numbered from 1
    double fps = 24;  ///< frames a second

    friend bool operator==(const Animation&, const Animation&) = default;
};

struct SceneMotion;

inline constexpr int kMaxImageSide = 65536;

/// The channels of a flat image. Data that none of them needs aren't computed.
struct ImageChannels {
    bool color = true;            ///< R G B A
    bool depth = true;            ///< Z
    bool position = true;         ///< P.X P.Y P.Z
    bool normal = true;           ///< N.X N.Y N.Z
    bool object = true;           ///< objectId
    bool distance = false;        ///< distance
    bool material = false;        ///< materialId
    bool object_matte = false;    ///< CryptoObject00 to CryptoObject02
    bool material_matte = false;  ///< CryptoMaterial00 to CryptoMaterial02
    bool albedo = false;          ///< albedo.R, albedo.G, albedo.B
    bool direct = false;          ///< direct.R ...: light that comes straight to the first surface
    bool indirect = false;        ///< indirect.R ...: all other light
    bool shadow = false;          ///< shadow.R ...: the part of the direct light that is hidden
    bool light_groups = false;    ///< light_GROUP.R ... of each group, and light_rest.R ...
    bool samples = false;         ///< samples: number of samples of each pixel
    bool noise = false;           ///< noise: the error that `RenderSettings::noise` limits
    bool variance = false;        ///< variance.R ...: of the mean of a pixel's samples

    /// True if some of the channels are parts of the light.
    bool has_passes() const { return albedo || direct || indirect || shadow || light_groups; }

    friend bool operator==(const ImageChannels&, const ImageChannels&) = default;
};

/// The kind of light that reaches surfaces.
enum class LightMode : uint8_t {
    local,   ///< light of lights, and along mirrored and refracted rays: Whitted 1980
    global,  ///< all light, along random paths from surface to surface: Kajiya 1986
};

/// The way in which paths of global light find emissive surfaces.
enum class EmitterSearch : uint8_t {
    both,   ///< by rays to them and by running into them, weighted by probability
    paths,  ///< by running into them
    rays,   ///< by rays to them, except in mirrors and glass
};

/// The position of an image in a larger picture.
struct ImageCrop {
    glm::ivec2 first{0};  ///< column and row of the image's first pixel
    glm::ivec2 frame{0};  ///< pixels of the whole picture; 0 for an image that is whole

    bool is_whole() const { return frame.x == 0; }
    friend bool operator==(const ImageCrop&, const ImageCrop&) = default;
};

/// The target at which a flat image has enough samples. Tiles stop one by one.
struct NoiseTarget {
    double error = 0;    ///< the standard error of a tile's pixels over their mean; 0: none
    double seconds = 0;  ///< maximum time for the image; 0: unlimited

    bool is_given() const { return error > 0 || seconds > 0; }
    friend bool operator==(const NoiseTarget&, const NoiseTarget&) = default;
};

/// With a target of noise, the number of samples after which as many are added and compared.
inline constexpr int kFirstSamples = 16;

struct RenderSettings {
    glm::ivec2 size{640, 480};  ///< pixels of the image
    double pixel_aspect = 1;    ///< the width of a pixel over its height
    ImageCrop crop;             ///< not in scene files
    int samples = 1;            ///< per pixel, 1..4096; the maximum if `noise` is given
    /// In local light, pixels whose neighbours differ by more than this contrast get all samples,
    /// other pixels one, 0..1; 0: all pixels get all samples.
    double adaptive = 0;
    int first_sample = 0;  ///< index in the sequence of samples; not in scene files
    int all_samples = 0;   ///< with those of other moments; 0: there are none; not in scene files
    ReconstructionFilter filter;
    int depth = 5;  ///< reflections and refractions in a row, 0..64
    bool shadows = true;
    bool filtered_shadows = false;   ///< refracting objects tint and dim light instead of hiding it
    double min_weight = 1.0 / 4096;  ///< paths that would add less than this share of a pixel end
    LightMode light = LightMode::local;
    int bounces = 8;  ///< global light: maximum number of times that a path is scattered, 0..64
    EmitterSearch emitters = EmitterSearch::both;
    bool scatters_samples = false;  ///< not in scene files: as has_scattered_samples() says, though
                                    ///< the light is local now
    bool direct_alone = false;      ///< not in scene files: lights light first surfaces alone
    bool transparent = false;       ///< observers see nothing where no object is; other rays do
    NoiseTarget noise;              ///< not in scene files
    ImageChannels channels;         ///< not in scene files: the channels of the outputs
    bool shows_image = true;        ///< not in scene files: flat images are wanted
    bool shows_volume = false;  ///< not in scene files: the display's volumetric images are wanted
    /// The image of the samples before `first_sample`, a power of two, to which others are added;
    /// with `noise`, its channels give the numbers of samples. Null: there is none. Not in scene
    /// files.
    std::shared_ptr<const Image> earlier;

    friend bool operator==(const RenderSettings&, const RenderSettings&) = default;
};

/// Everything that a scene file says, as it is at frame 1; `scene_at` gives other frames. Indices
/// are in range, numbers finite and in their documented ranges.
struct Scene {
    std::filesystem::path file;
    World world;
    std::vector<Material>
        materials;  ///< number 0 is `default`, whether the scene defines it or not
    std::vector<Model> models;
    std::vector<Object> objects;
    std::vector<Light> lights;
    Observer observer;
    Animation animation;
    std::shared_ptr<const SceneMotion> motion;  ///< null: the world stands still
    RenderSettings render;
    Fitted fitted;  ///< parts that were left out, with values found from the objects
    bool has_default_light = false;  ///< the only light follows the observer: none was given

    friend bool operator==(const Scene&, const Scene&) = default;
};

/// Changes the size of the image, which becomes a whole picture, and with it the angles of a
/// display with square pixels and the position of a fitted observer.
void resize(Scene& scene, glm::ivec2 size);

/// The size of the whole picture, pixels.
inline glm::ivec2 frame_size(const RenderSettings& render) {
    return render.crop.is_whole() ? render.size : render.crop.frame;
}

/// The sides of the whole picture as it is shown, in units of a pixel's height.
inline glm::dvec2 proportions(const RenderSettings& render) {
    return glm::dvec2(frame_size(render)) * glm::dvec2(render.pixel_aspect, 1);
}

/// Makes the image a part of the picture: `size` pixels from column and row `first` on, which must
/// lie in it. Displays and observers stay those of the whole picture.
void crop(Scene& scene, glm::ivec2 first, glm::ivec2 size);

/// The number of samples of a pixel, including those of other moments.
inline int all_samples(const RenderSettings& render) {
    return render.all_samples > 0 ? render.all_samples : render.samples;
}

/// True if each pixel has its samples at places of its own. All channels of an image have the same.
inline bool has_scattered_samples(const RenderSettings& render) {
    return render.scatters_samples || render.light == LightMode::global || render.noise.is_given();
}

/// True if samples are added to those of an earlier image.
inline bool adds_samples(const RenderSettings& render) {
    return render.earlier || render.all_samples > 0;
}

/// Throws Error::usage for a part of a picture that cuts tiles whose noise is to be measured.
void check_tiles(const RenderSettings& render);

/// Sets each model's extent: the world's box transformed into the space of every object that shows
/// the model.
void find_extents(Scene& scene);

/// A description of the scene in lines for people: world, models, objects, lights, observer.
std::string describe(const Scene& scene);

}  // namespace voxelume
