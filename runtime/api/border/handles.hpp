// SPDX-License-Identifier: Apache-2.0
// What stands behind the handles that callers have.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/image/image.hpp"
#include "runtime/image/volume.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/voxelume/device.hpp"
#include "runtime/voxelume/image.hpp"
#include "runtime/voxelume/process.hpp"
#include "runtime/voxelume/scene.hpp"
#include "runtime/voxelume/volume.hpp"

namespace voxelume {

namespace api {

/// The files that were read to fit a scene, for the first call that renders or plans it.
class ReadAssets {
  public:
    ReadAssets(AssetStore store, v1::CacheOptions cache)
        : store_(std::move(store)), cache_(std::move(cache)) {}

    /// Hands the store over, to the first caller that uses the same cache; empty for all others.
    std::optional<AssetStore> take(const v1::CacheOptions& cache);

  private:
    std::mutex mutex_;
    std::optional<AssetStore> store_;
    v1::CacheOptions cache_;
};

/// Texts for the header of a file.
using Attributes = std::map<std::string, std::string>;

/// The name of the attribute that has a file's stamp.
inline constexpr const char* kStamp = "stamp";
/// The name of the attribute that has the hash of an image's frame, from which stamps are made.
inline constexpr const char* kFrameHash = "frame hash";

/// Present in the texts of images that show nothing where no object is: PNG files keep their alpha.
inline constexpr const char* kTransparent = "transparent";

}  // namespace api

struct v1::Device::Implementation {
    voxelume::Device device;
    v1::DeviceInfo info;
};

struct v1::Scene::Implementation {
    voxelume::Scene scene;
    std::string hash;                       ///< hash of the document that the scene was read from
    std::shared_ptr<api::ReadAssets> read;  ///< shared by scenes that differ in settings alone
};

struct v1::Image::Implementation {
    std::shared_ptr<const voxelume::Image> image;
    api::Attributes attributes;  ///< in addition to the image's own
    bool holds_codes = false;
};

struct v1::Volume::Implementation {
    std::shared_ptr<voxelume::Volume> volume;  ///< shared by frames that show the same
    api::Attributes attributes;                ///< instead of the volume's own
    v1::VolumeFrame frame;
};

namespace api {

v1::DeviceInfo info_for_callers(const DeviceInfo& info);

v1::Scene handle_of(Scene scene, std::string hash, std::shared_ptr<ReadAssets> read);
v1::Image handle_of(std::shared_ptr<const Image> image, Attributes attributes = {},
                    bool holds_codes = false);
v1::Volume handle_of(std::shared_ptr<Volume> volume, Attributes attributes);

inline const Scene& inside(const v1::Scene& scene) {
    return scene.implementation().scene;
}
/// The store to render a scene from: what was read with it, if that wasn't taken before.
AssetStore assets_of(const v1::Scene& scene, const v1::CacheOptions& cache);

inline const Device& inside(const v1::Device& device) {
    return device.implementation().device;
}
inline const Image& inside(const v1::Image& image) {
    return *image.implementation().image;
}
inline const Volume& inside(const v1::Volume& volume) {
    return *volume.implementation().volume;
}

/// The devices inside these handles. Throws Error::usage if there are none.
std::vector<Device> inside(const std::vector<v1::Device>& devices);

}  // namespace api

}  // namespace voxelume
