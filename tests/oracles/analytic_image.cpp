// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/analytic_image.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "runtime/verify/analytic/analytic_tracer.hpp"

namespace voxelume::oracle {
namespace {

bool has_another_around(const std::vector<uint64_t>& signatures, int width, int height, int x,
                        int y) {
    const uint64_t own = signatures[size_t(y) * size_t(width) + size_t(x)];
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i)
            if (signatures[size_t(j) * size_t(width) + size_t(i)] != own) return true;
    return false;
}

}  // namespace

AnalyticImage analytic_image(const Scene& scene) {
    const Observer& observer = scene.observer;
    const Display& display = observer.display;
    if (display.shape != DisplayShape::pyramid)
        throw std::invalid_argument("the analytic image is that of a pyramid");
    const AnalyticTracer tracer(scene);
    AnalyticImage image{scene.render.size.x, scene.render.size.y, {}, {}};
    std::vector<uint64_t> signatures;
    for (int row = 0; row < image.height; ++row) {
        for (int column = 0; column < image.width; ++column) {
            const double right = 2 * (column + 0.5) / image.width - 1;
            const double down = 2 * (row + 0.5) / image.height - 1;
            const glm::dvec3 ray(-right * std::tan(display.half_angles.x),
                                 -down * std::tan(display.half_angles.y), 1);
            const double stretch = glm::length(ray);  // near and far are planes
            const Seen seen =
                tracer.trace(observer.position, observer.world_from_observer * ray / stretch,
                             display.near * stretch, display.far * stretch);
            image.radiance.push_back(seen.radiance);
            signatures.push_back(seen.signature);
        }
    }
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            image.edge.push_back(has_another_around(signatures, image.width, image.height, x, y));
    return image;
}

}  // namespace voxelume::oracle
