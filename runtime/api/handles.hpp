// SPDX-License-Identifier: Apache-2.0
// What stands behind the handles that callers have.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "runtime/image/image.hpp"
#include "runtime/image/volume.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/voxelume/device.hpp"
#include "runtime/voxelume/image.hpp"
#include "runtime/voxelume/scene.hpp"
#include "runtime/voxelume/volume.hpp"

namespace voxelume {

namespace api {

/// Texts for the header of a file.
using Attributes = std::map<std::string, std::string>;

}  // namespace api

struct v1::Device::Implementation {
    voxelume::Device device;
    v1::DeviceInfo info;
};

struct v1::Scene::Implementation {
    voxelume::Scene scene;
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

v1::Scene handle_of(Scene scene);
v1::Image handle_of(std::shared_ptr<const Image> image, Attributes attributes = {},
                    bool holds_codes = false);
v1::Volume handle_of(std::shared_ptr<Volume> volume, Attributes attributes);

inline const Scene& inside(const v1::Scene& scene) {
    return scene.implementation().scene;
}
inline const Device& inside(const v1::Device& device) {
    return device.implementation().device;
}
inline const Image& inside(const v1::Image& image) {
    return *image.implementation().image;
}
inline const Volume& inside(const v1::Volume& volume) {
    return *volume.implementation().volume;
}

/// Throws Error::usage for no device.
std::vector<Device> inside(const std::vector<v1::Device>& devices);

}  // namespace api

}  // namespace voxelume
