// SPDX-License-Identifier: Apache-2.0
#include "runtime/batch/banded_image.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace voxelume {

void BandedImage::render(const Device& device, const Scene& scene, const BuiltWorld& world,
                         RenderReport& report, const Moments* moments) {
    Renderer renderer(device, false);
    renderer.set_moments(moments);
    Scene whole = scene;
    whole.render.size = whole_.size;
    whole.render.crop = whole_.crop;
    while (const std::optional<int> band = take()) {
        RenderReport of_band;
        const auto progress = [&](uint32_t done, uint32_t total) {
            advance(*band, double(done) / total);
        };
        auto image = std::make_shared<const Image>(
            renderer.new_image(band_of(whole, bands_, *band), world, of_band, progress));
        add_counts(of_band, report);
        report.image_seconds += of_band.image_seconds;
        report.moments = std::max(report.moments, of_band.moments);
        report.voxels = of_band.voxels;
        report.world_bytes = of_band.world_bytes;
        put(*band, std::move(image));
    }
}

void BandedImage::close() {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
    changed_.notify_all();
}

std::optional<int> BandedImage::take() {
    const std::lock_guard lock(mutex_);
    if (is_closed_ || taken_ == bands_.count) return std::nullopt;
    return taken_++;
}

void BandedImage::put(int band, std::shared_ptr<const Image> image) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return is_closed_ || given_ == band; });
    if (is_closed_) return;
    if (!shown_.light) {
        const ShownContent content = content_of(*image);
        shown_.objects |= content.objects;
        shown_.light |= content.objects && content.light;
    }
    lock.unlock();  // no other thread's turn comes meanwhile
    sink_.add(image);
    image.reset();
    lock.lock();
    ++given_;
    changed_.notify_all();
}

void BandedImage::advance(int band, double part) {
    constexpr uint32_t kSteps = 1 << 20;
    const std::lock_guard lock(progress_mutex_);
    done_[size_t(band)] = part;
    const double sum = std::accumulate(done_.begin(), done_.end(), 0.0) / double(done_.size());
    progress_(uint32_t(sum * kSteps), kSteps);
}

}  // namespace voxelume
