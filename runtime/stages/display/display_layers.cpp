// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/display_layers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <span>

namespace voxelume {
namespace {

/// Below this transmittance, light from behind counts as none.
constexpr double kMinTransmittance = 1.0 / (1 << 20);
/// The medium's own light is known at any transmittance; this limit only keeps quotients finite.
constexpr double kMinSpaceTransmittance = 1e-250;

/// One sample of a ray in a voxel. Samples of one voxel are in order, the nearest first.
struct Sample {
    uint64_t index;
    glm::dvec3 light;  ///< the light that it adds when nothing covers it
    double opacity;
    float depth;      ///< metres
    uint32_t object;  ///< number of the object plus 1; 0 for the environment
};

/// The pixel of a ray in the order of sight.cl: tiles of 4 x 4.
glm::ivec2 pixel_of(uint32_t ray, int width) {
    const int tiles = (width + 3) / 4, tile = int(ray / 16), within = int(ray % 16);
    return {tile % tiles * 4 + (within & 3), tile / tiles * 4 + (within >> 2)};
}

class Assembly {
  public:
    Assembly(const LayerEnvironment& environment, const VolumeFrame& frame)
        : environment_(environment),
          size_(frame.size),
          absorption_(double(environment.environment.absorption.x),
                      double(environment.environment.absorption.y),
                      double(environment.environment.absorption.z)),
          color_(double(environment.environment.color.x), double(environment.environment.color.y),
                 double(environment.environment.color.z)),
          throughput_(size_t(size_.x) * size_t(size_.y), 1.0) {}

    void add(const LayerRecords& layer) {
        for (size_t n = 0; n < layer.count; ++n) add_record(layer, n);
    }
    std::vector<Sample> take() { return std::move(samples_); }

  private:
    static uint32_t word(const LayerRecords& layer, size_t n, size_t i) {
        return layer.words[i * layer.count + n];
    }
    static double number(const LayerRecords& layer, size_t n, size_t i) {
        return double(std::bit_cast<float>(word(layer, n, i)));
    }
    static glm::dvec3 numbers(const LayerRecords& layer, size_t n, size_t i) {
        return {number(layer, n, i), number(layer, n, i + 1), number(layer, n, i + 2)};
    }

    void add_record(const LayerRecords& layer, size_t n) {
        const glm::ivec2 pixel = pixel_of(word(layer, n, VXL_LAYER_RAY), size_.x);
        if (pixel.x >= size_.x || pixel.y >= size_.y) return;  // outside the image
        const uint64_t column = uint64_t(pixel.x) + uint64_t(size_.x) * uint64_t(pixel.y);
        glm::dvec3 light = numbers(layer, n, VXL_LAYER_LIGHT);
        const bool in_medium = word(layer, n, VXL_LAYER_IN_MEDIUM) != 0;
        if (in_medium && environment_.steps.absorption > 0)
            light -= add_environment(layer, n, column);
        const double opacity = number(layer, n, VXL_LAYER_OPACITY);
        const uint32_t object = word(layer, n, VXL_LAYER_OBJECT);
        if (object == 0 || !(opacity > 0)) return;
        const auto depth = float(number(layer, n, VXL_LAYER_DEPTH));
        put(column,
            {index_of(column, word(layer, n, VXL_LAYER_STEP)), light, opacity, depth, object},
            1 - opacity, kMinTransmittance);
    }

    /// For each step of a ray's path to a surface, from step `first` on: the medium's density times
    /// metres, and the light that it adds there if nothing covers it.
    struct Way {
        uint32_t first = 0;
        std::vector<double> amounts;
        std::vector<glm::dvec3> lights;

        void add_step() {
            amounts.push_back(0);
            lights.emplace_back(0);
        }
    };
    Way way_of(const LayerRecords& layer, size_t n) const {
        const double begin = number(layer, n, VXL_LAYER_BEGIN),
                     end = number(layer, n, VXL_LAYER_END),
                     ratio = number(layer, n, VXL_LAYER_RATIO),
                     step = double(environment_.steps.step);
        if (!(begin < end)) return {};
        const auto step_at = [&](double depth) {
            return uint32_t(std::clamp(std::floor(depth / step), 0.0, double(size_.z - 1)));
        };
        const bool is_hit = word(layer, n, VXL_LAYER_OBJECT) != 0;
        const uint32_t last = is_hit ? word(layer, n, VXL_LAYER_STEP) : step_at(end);
        Way way;
        if (layer.first_amount.empty()) {
            way.first = step_at(begin);
            for (uint32_t k = way.first; k <= last; ++k) {
                way.add_step();
                add_behind(
                    std::max(std::min((k + 1) * step, end) - std::max(k * step, begin), 0.0) *
                        ratio,
                    nullptr, way);
            }
            return way;
        }
        way.first = std::min(layer.first_step[n], last);
        const size_t from = layer.first_amount[n], to = layer.first_amount[n + 1];
        for (size_t i = from; i < to; ++i) {
            // Rounding may put a small amount beyond the surface.
            if (way.first + way.amounts.size() <= last) way.add_step();
            add_behind(double(layer.amounts[i]), layer.lights.empty() ? nullptr : &layer.lights[i],
                       way);
        }
        return way;
    }

    /// Adds an amount of medium to the last step of a way. `light` is the light that it adds, given
    /// if its colour varies.
    void add_behind(double amount, const glm::vec3* light, Way& way) const {
        const glm::dvec3 own =
            light ? glm::dvec3(*light) : color_ * (1.0 - glm::exp(-absorption_ * amount));
        way.lights.back() += glm::exp(-absorption_ * way.amounts.back()) * own;
        way.amounts.back() += amount;
    }

    /// Adds the voxels of the medium along a ray's path to a surface. Returns the light that they
    /// add.
    glm::dvec3 add_environment(const LayerRecords& layer, size_t n, uint64_t column) {
        const glm::dvec3 throughput = numbers(layer, n, VXL_LAYER_THROUGHPUT);
        const Way way = way_of(layer, n);
        glm::dvec3 sum(0);
        double before = 0;
        for (size_t i = 0; i < way.amounts.size(); ++i) {
            const double inside = way.amounts[i];
            if (!(inside > 0)) continue;
            const auto k = uint32_t(way.first + i);
            const glm::dvec3 light = throughput * glm::exp(-absorption_ * before) * way.lights[i];
            const double covered = double(environment_.steps.absorption) * inside;
            const auto depth = float((k + 0.5) * double(environment_.steps.step) +
                                     double(environment_.near_depth));
            put(column, {index_of(column, k), light, -std::expm1(-covered), depth, 0},
                std::exp(-covered), kMinSpaceTransmittance);
            sum += light;
            before += inside;
        }
        return sum;
    }

    uint64_t index_of(uint64_t column, uint32_t k) const {
        return column + uint64_t(size_.x) * uint64_t(size_.y) * k;
    }

    /// Adds a voxel that lets a part of the light behind it through. Its light is what reaches E,
    /// so it is divided by the transmittance of the voxels in front.
    void put(uint64_t column, Sample voxel, double leaves, double min_transmittance) {
        double& throughput = throughput_[column];
        voxel.light = glm::max(voxel.light / std::max(throughput, min_transmittance), 0.0);
        samples_.push_back(voxel);
        throughput *= leaves;
    }

    LayerEnvironment environment_;
    glm::ivec3 size_;
    glm::dvec3 absorption_, color_;
    std::vector<double> throughput_;  ///< for each ray: the part that its voxels so far leave
                                      ///< uncovered
    std::vector<Sample> samples_;
};

/// Composites the samples of one voxel. The first sample with an object names the voxel.
Sample merged(std::span<const Sample> samples) {
    Sample sum = samples.front();
    for (const Sample& sample : samples.subspan(1)) {
        sum.light += (1 - sum.opacity) * sample.light;
        sum.opacity += (1 - sum.opacity) * sample.opacity;
        if (sum.object == 0 && sample.object != 0)
            sum.object = sample.object, sum.depth = sample.depth;
    }
    return sum;
}

}  // namespace

void assemble_layers(const std::vector<LayerRecords>& layers, const LayerEnvironment& environment,
                     Volume& volume) {
    Assembly assembly(environment, volume.frame);
    for (const LayerRecords& layer : layers) assembly.add(layer);
    std::vector<Sample> samples = assembly.take();
    std::ranges::stable_sort(samples, {}, &Sample::index);
    for (size_t first = 0, end = 0; first < samples.size(); first = end) {
        while (end < samples.size() && samples[end].index == samples[first].index) ++end;
        const Sample voxel = merged(std::span(samples).subspan(first, end - first));
        volume.indices.push_back(voxel.index);
        volume.colors.emplace_back(voxel.light / voxel.opacity);
        volume.opacities.push_back(float(voxel.opacity));
        volume.depths.push_back(voxel.depth);
        volume.objects.push_back(voxel.object);
        volume.kinds.push_back(voxel.object == 0 ? VoxelKind::space : VoxelKind::object);
    }
}

}  // namespace voxelume
