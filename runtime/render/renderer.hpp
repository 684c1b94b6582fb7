// SPDX-License-Identifier: Apache-2.0
// scene -> image: the paper's algorithm, stage by stage.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "runtime/image/image.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/render/noise.hpp"
#include "runtime/render/tile_share.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/trace/beam.hpp"
#include "runtime/world/world.hpp"

namespace voxelume {

class Illumination;
struct LightPass;
struct Moments;

/// The work and time of a frame, for the summary line, --stats-json and the tests.
struct RenderReport {
    WorldReport world;
    double image_seconds = 0;  ///< sight, trace, shade and resolve, including building their
                               ///< kernels
    uint64_t voxels = 0;       ///< surface voxels in the world's pyramid
    uint64_t world_bytes = 0;  ///< bytes of the pyramid on the device
    uint64_t sight_rays = 0;
    uint64_t contrasting_pixels = 0;  ///< pixels of an adaptive image that got all samples
    uint64_t beams = 0;               ///< number sent, each for 16 sight rays; 0 if they don't pay
    uint64_t clear_beams = 0;    ///< number of those that meet nothing: their rays ended at once
    uint64_t display_lines = 0;  ///< probe lines along a display's lattice
    uint64_t clear_display_lines = 0;  ///< lines not sent because they miss all objects
    uint64_t shadow_rays = 0;
    uint64_t light_beams = 0;  ///< sent from lights, to find where shadow rays end; without those
                               ///< retained
    uint64_t secondary_rays = 0;    ///< reflected, refracted, and continued through surfaces
    uint64_t ended_paths = 0;       ///< paths not followed because of their small weight
    uint64_t medium_overflows = 0;  ///< rays that entered more overlapping objects than they can
                                    ///< remember: the image is wrong there
    uint32_t not_finite = 0;        ///< values that became 0; more than 0 is a fault of the program
    uint32_t moments = 0;           ///< number of moments of samples; 0: the frame's alone
    NoiseReached noise;             ///< only for images with a target
    NoiseReached volume_noise;      ///< only for volumetric images with a target
    bool is_kept = false;           ///< true if the frame shows the image of the frame before
    bool hits_are_kept = false;  ///< true if its sight rays meet what they met in the frame before
};

/// Adds the counts of rays, paths and faults to `sum`.
void add_counts(const RenderReport& report, RenderReport& sum);

/// Renders the flat images of successive frames, and retains what the next may show again: the
/// whole image, or the hits of its sight rays, which don't change with lights, materials or the
/// medium. A frame's bits don't depend on the frames before it.
class Renderer {
  public:
    /// With `follows` = false no second frame follows the first, and nothing is retained.
    explicit Renderer(const Device& device, bool follows = true)
        : device_(device), follows_(follows) {}

    /// Lets the samples of the images that follow show these moments, or with null the frame alone.
    void set_moments(const Moments* moments) { moments_ = moments; }

    /// The image of the scene's observer in the scene's world. Throws Error as the stages do.
    std::shared_ptr<const Image> image(const Scene& scene, const BuiltWorld& world,
                                       RenderReport& report, const FrameProgress& progress = {});

    /// Renders the image as `image` does, but the next frame can't show it again as a whole.
    Image new_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                    const FrameProgress& progress = {});

    /// The tiles of an image that one of several renderers takes.
    struct Tiles {
        TileShare& share;
        std::vector<TileRange>& taken;  ///< the tiles that it rendered
        double weight = 1;              ///< part of this image in the share's progress
        /// The pixels that tiles consist of, 16 each; empty: squares of 4 x 4 pixels.
        std::span<const uint32_t> pixels{};
    };

    /// Renders those tiles of the image that are left in `tiles`; the others are undefined.
    Image part_of_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                        const Tiles& tiles);

  private:
    /// The data on which the first surfaces along sight rays depend.
    struct View {
        uint64_t world = 0;
        Observer observer;
        RenderSettings settings;
        Features features;            ///< features on which hits depend
        std::vector<bool> transmits;  ///< for each material
        friend bool operator==(const View&, const View&) = default;
    };
    /// The rays and hits of one batch.
    struct SightHits {
        uint32_t first = 0;  ///< the first tile
        Buffer<float> rays;
        Buffer<uint32_t> hits;
    };

    /// The source of the hits of an image's sight rays, and whether they are retained.
    struct ViewHits {
        View view;
        uint32_t in_batch = 0;   ///< maximum number of tiles
        bool are_lent = false;   ///< lent by the lender
        bool are_known = false;  ///< lent, or retained from the image before
        bool are_kept = false;   ///< retained for the next image
    };

    /// The places where an image got more samples, so that its passes get the same.
    struct Sampled {
        std::vector<int> tiles;  ///< each tile's samples; empty: as many as they need
        std::optional<std::vector<uint32_t>> pixels;  ///< contrasting pixels; none: not known yet
    };

    struct WorldDilation {
        uint64_t world = 0;
        DilatedOccupancy dilated_occupancy;
        std::vector<LightBeams> light_beams;  ///< beams of the last frame's lights
    };

    static View view_of(const Scene& scene, const BuiltWorld& world, const Features& features);
    static bool have_equal_hits(const View& a, const View& b);
    bool lends_hits(const View& view, uint32_t max_tiles) const;
    static double first_weight(const Scene& scene, double weight);
    bool has_room(const Scene& scene, const Features& features, uint64_t rays) const;
    Features features_shown(const Scene& scene, const Pyramid& world) const;
    ViewHits begin_view(const Scene& scene, const BuiltWorld& world, const Features& features,
                        int samples, const TileShare& share);
    void take_known(const ViewHits& hits, uint32_t first, RayBatch& batch) const;
    WorldDilation& dilated_occupancy_of(const BuiltWorld& world, DilationLevel of);
    void note_done(const TileRange& range, const Tiles& tiles, double part) const;
    static void send_light_beams(WorldDilation& through, uint32_t max, Illumination& illumination);
    Image sampled_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                        const Tiles& tiles, Sampled& sampled);
    Image noisy_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                      const Tiles& tiles, std::vector<int>& given);
    Image more_samples(const Scene& part, const BuiltWorld& world, RenderReport& report,
                       const Tiles& tiles) const;
    Image adaptive_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                         const Tiles& tiles, Sampled& sampled);
    struct Sums;
    Sums begin_sums(const Scene& scene, const Tiles& tiles) const;
    void add_moment(const Scene& scene, const BuiltWorld& world, const Tiles& tiles,
                    const Sums& sums, RenderReport& report);
    Scene scene_of_moment(Scene now, const Scene& asked) const;
    double add_moments(const Scene& scene, const Tiles& tiles, Sums& sums, RenderReport& report);
    void show_moments_of(const Renderer& image, std::optional<size_t> pass);
    Image image_of_tiles(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                         const Tiles& tiles);
    void add_passes(const std::vector<LightPass>& passes, const BuiltWorld& world,
                    const Tiles& tiles, Sampled& sampled, RenderReport& report, Image& image) const;

    Device device_;
    bool follows_;
    bool is_white_ = false;  ///< voxels show no colours of their own
    const Moments* moments_ = nullptr;
    RenderSettings image_settings_;  ///< with moments: those of the image, also in its passes
    std::optional<size_t> pass_;     ///< with moments: the number of the pass that is rendered
    bool has_passes_ = false;  ///< hits are retained until the passes of the light are rendered
    const Renderer* lender_ = nullptr;  ///< in a pass: the renderer with the image's hits
    std::optional<Scene> scene_;        ///< the scene whose image is retained
    uint64_t world_ = 0;                ///< the version of its world
    std::shared_ptr<const Image> image_;
    RenderReport report_;
    std::optional<WorldDilation> dilated_occupancy_;
    std::optional<View> view_;
    std::vector<SightHits> hits_;  ///< those of each batch of the view; empty if there is no room
                                   ///< for them
    uint32_t tiles_in_batch_ = 0;  ///< maximum number of tiles
};

/// Renders the image of a single frame.
///
/// Throws Error::limit before memory is allocated if the scene's plan doesn't fit the device, and
/// Error as the stages do.
Image render(const Device& device, const Scene& scene, RenderReport& report,
             const FrameProgress& progress = {});

}  // namespace voxelume
