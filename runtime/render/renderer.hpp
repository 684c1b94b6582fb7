// scene -> image: the paper's algorithm, stage by stage.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "runtime/image/image.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/render/tile_share.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/trace/beam.hpp"
#include "runtime/world/world.hpp"

namespace voxelume {

/// What a frame took, for the summary line, --stats-json and the tests.
struct RenderReport {
    WorldReport world;
    double image_seconds = 0;  ///< sight, trace, shade and resolve, with building their kernels
    uint64_t voxels = 0;       ///< surface voxels in the world's pyramid
    uint64_t world_bytes = 0;  ///< of the pyramid on the device
    uint64_t sight_rays = 0;
    uint64_t beams = 0;          ///< sent along 16 sight rays each; none where they don't pay
    uint64_t clear_beams = 0;    ///< of these, those that see nothing: their rays ended at once
    uint64_t display_lines = 0;  ///< probe lines along a display's lattice
    uint64_t clear_display_lines = 0;  ///< not sent, as they pass all objects by
    uint64_t shadow_rays = 0;
    uint64_t light_beams = 0;       ///< sent from lights, where shadow rays end; without those kept
    uint64_t secondary_rays = 0;    ///< reflected, refracted, and gone on through surfaces
    uint64_t ended_paths = 0;       ///< not followed for their small weight
    uint64_t medium_overflows = 0;  ///< rays that came into more overlapping objects than they can
                                    ///< remember: the image is wrong there
    uint32_t not_finite = 0;        ///< values that became 0; more than 0 is a fault of ours
    bool is_kept = false;           ///< the frame shows what the one before showed
    bool hits_are_kept = false;     ///< its sight rays meet what they met before
};

/// Adds what was counted, of rays, of paths and of faults.
void add_counts(const RenderReport& report, RenderReport& sum);

/// Renders the flat images of one frame after another, and keeps what the next may show again: the
/// whole image, or what its sight rays meet, which a change of lights, materials or medium leaves
/// as it is. A frame's bits don't depend on what came before it.
class Renderer {
  public:
    /// Where nothing `follows` the first frame, nothing is kept.
    explicit Renderer(const Device& device, bool follows = true)
        : device_(device), follows_(follows) {}

    /// The image of the scene's observer in the scene's world. Throws Error as the stages do.
    std::shared_ptr<const Image> image(const Scene& scene, const BuiltWorld& world,
                                       RenderReport& report, const FrameProgress& progress = {});

    /// The same, which the next frame can't show again as a whole.
    Image new_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                    const FrameProgress& progress = {});

    /// Tiles that one of several renderers takes of an image.
    struct Tiles {
        TileShare& share;
        std::vector<TileRange>& taken;  ///< those that it made
    };

    /// The image with those tiles made that are left of `tiles`; the others are undefined.
    Image part_of_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                        const Tiles& tiles);

  private:
    /// What decides the first surfaces that sight rays meet.
    struct View {
        uint64_t world = 0;
        Observer observer;
        RenderSettings settings;
        Features features;            ///< those that hits depend on
        std::vector<bool> transmits;  ///< of each material
        friend bool operator==(const View&, const View&) = default;
    };
    /// The rays and hits of one batch.
    struct SightHits {
        Buffer<float> rays;
        Buffer<uint32_t> hits;
    };

    struct WorldDilation {
        uint64_t world = 0;
        DilatedOccupancy dilated_occupancy;
        std::vector<LightBeams> light_beams;  ///< of the last frame's lights
    };

    static View view_of(const Scene& scene, const BuiltWorld& world, const Features& features);
    bool has_room(const Scene& scene, const Features& features, uint64_t rays) const;
    WorldDilation& dilated_occupancy_of(const BuiltWorld& world, DilationLevel of);
    void note_done(const TileRange& range, const Tiles& tiles) const;
    Image image_of_tiles(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                         const Tiles& tiles);

    Device device_;
    bool follows_;
    std::optional<Scene> scene_;  ///< whose image is kept
    uint64_t world_ = 0;          ///< in which world
    std::shared_ptr<const Image> image_;
    RenderReport report_;
    std::optional<WorldDilation> dilated_occupancy_;
    std::optional<View> view_;
    std::vector<SightHits> hits_;  ///< of each batch of the view; empty where they have no room
};

/// Renders the image of a single frame.
///
/// Throws Error::limit before memory is taken when the scene's plan doesn't fit the device, and
/// Error as the stages do.
Image render(const Device& device, const Scene& scene, RenderReport& report,
             const FrameProgress& progress = {});

}  // namespace voxelume
