// SPDX-License-Identifier: Apache-2.0
// world -> an image that is larger than memory, in bands from the top down.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "runtime/memory/image_bands.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/render/shown_content.hpp"

namespace voxelume {

/// Takes the bands of one image.
class BandSink {
  public:
    virtual ~BandSink() = default;

    /// Takes the next band, from the top down; one thread at a time calls it. What it throws ends
    /// the run.
    virtual void add(const std::shared_ptr<const Image>& band) = 0;

    /// Hears that all bands were given, and what the image took. The thread that called
    /// `render_frames` calls it.
    virtual void finish(const RenderReport& report) = 0;
};

/// The bands of one image, which one device renders, or several in turn.
class BandedImage {
  public:
    /// `whole` are the settings of the whole image.
    BandedImage(const ImageBands& bands, RenderSettings whole, BandSink& sink,
                FrameProgress progress)
        : bands_(bands),
          whole_(std::move(whole)),
          sink_(sink),
          progress_(std::move(progress)),
          done_(size_t(bands.count)) {}

    /// Renders bands until none is left, and hands each on after those above it. `scene` may be
    /// that of any band, whose samples may show `moments`. Adds what the bands took to `report`.
    void render(const Device& device, const Scene& scene, const BuiltWorld& world,
                RenderReport& report, const Moments* moments = nullptr);

    /// Ends the image early: devices take no further bands and drop the one that they have.
    void close();

    /// The content of all bands together.
    const ShownContent& shown() const { return shown_; }

  private:
    std::optional<int> take();
    void put(int band, std::shared_ptr<const Image> image);
    void advance(int band, double part);

    ImageBands bands_;
    RenderSettings whole_;
    BandSink& sink_;
    FrameProgress progress_;
    std::mutex mutex_, progress_mutex_;
    std::condition_variable changed_;
    int taken_ = 0, given_ = 0;
    bool is_closed_ = false;
    std::vector<double> done_;  ///< the part of each band that is done
    ShownContent shown_{false, false};
};

}  // namespace voxelume
