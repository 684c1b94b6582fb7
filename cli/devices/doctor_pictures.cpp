// SPDX-License-Identifier: Apache-2.0
#include "cli/devices/doctor_pictures.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <memory>
#include <numeric>
#include <span>

namespace voxelume::cli {
namespace {

class Hasher {
  public:
    Hasher() : state_(XXH3_createState(), &XXH3_freeState) { XXH3_64bits_reset(state_.get()); }

    template <class Value>
    void add(std::span<const Value> values) {
        XXH3_64bits_update(state_.get(), values.data(), values.size_bytes());
    }
    std::string digits() const { return fmt::format("{:016x}", XXH3_64bits_digest(state_.get())); }

  private:
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

void add(const Image& image, Hasher& hasher) {
    for (const std::string& channel : image.channels()) hasher.add(image.plane(channel));
    hasher.add(image.object_ids());
    hasher.add(image.material_ids());
}

void add(const Volume& volume, Hasher& hasher) {
    hasher.add(volume.indices());
    hasher.add(volume.colors());
    hasher.add(volume.opacities());
    hasher.add(volume.depths());
    hasher.add(volume.object_ids());
}

/// All channels that kernels fill, except those about motion, samples and noise.
Channels all_channels() {
    Channels channels = kNoChannels;
    for (const ChannelRow& row : channel_table()) channels.*row.member = true;
    channels.motion = channels.samples = channels.noise = channels.variance = false;
    return channels;
}

}  // namespace

KnownFiles::KnownFiles() : folder_(make_temporary_folder()) {
    for (const KnownFile& file : known_files()) write_file(folder() / file.name, file.text);
}

std::string hash_of_render(const KnownPicture& picture, const KnownFiles& files,
                           const Device& device, const std::stop_token& stop) {
    const Scene scene =
        Scene::parse(picture.scene, files.folder() / fmt::format("{}.json", picture.name));
    Hasher hasher;
    FrameJob job;
    job.frames.resize(size_t(scene.frames()));
    for (size_t i = 0; i < job.frames.size(); ++i) job.frames[i].frame = int(i) + 1;
    (picture.is_volume ? job.deliver_volumes : job.deliver_images) = true;
    job.deliver = [&hasher](const RenderedFrame& frame) {
        if (frame.image) add(*frame.image, hasher);
        if (frame.volume) add(*frame.volume, hasher);
    };
    RenderOptions options;
    options.channels = all_channels();
    options.cache.enabled = false;
    options.stop = stop;
    render_frames(scene, {device}, job, options);
    return hasher.digits();
}

}  // namespace voxelume::cli
