// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/light_tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "runtime/grid/grid_arguments.hpp"

namespace voxelume {
namespace {

/// A light's least share of the power. Weights of what shines are well above 0 as floats.
constexpr double kLeastShare = 1e-9;

/// By how much bounds are loosened, so that rounding doesn't make them too narrow.
constexpr double kSlack = 1e-6;

constexpr float kEverywhere = -2;  ///< LightNode::cosine of light in all directions

glm::dvec3 vector_of(const float4& v) {
    return {v.x, v.y, v.z};
}

/// The luminance of the light that is sent to where it is brightest.
double power_of(const LightRecord& light) {
    const glm::dvec3 intensity = vector_of(light.intensity);
    return glm::dot(intensity, glm::dvec3(0.2126, 0.7152, 0.0722));
}

size_t leaves_for(size_t count) {
    return std::bit_ceil(std::max<size_t>(count, 2));
}

/// A light on the way into the tree.
struct Leaf {
    PathLight light;
    glm::dvec3 metres;  ///< its position
    double share = 0;   ///< of the power
    double radius = 0;  ///< of the ball around it, metres
};

/// Fills the nodes of a tree from the lights of each.
class LightTreeMaker {
  public:
    LightTreeMaker(std::span<const PathLight> lights, const GridFrame& world)
        : edge_(world.voxel_edge),
          content_{{}, {}, std::vector<LightNode>(2 * leaves_for(lights.size()))} {
        content_.lights.resize(leaves_for(lights.size()));
        if (lights.front().area) content_.areas.resize(content_.lights.size());
        double power = 0;
        for (const PathLight& light : lights) power += power_of(light.record);
        for (const PathLight& light : lights)
            leaves_.push_back({light, vector_of(light.record.position) * edge_,
                               std::max(power_of(light.record) / power, kLeastShare),
                               light.area ? radius_of(*light.area, world) : 0});
    }

    LightTreeContent make() && {
        divide(1, leaves_, content_.lights.size());
        return std::move(content_);
    }

  private:
    /// `room`: the number of leaves below the node.
    void divide(size_t node, std::span<Leaf> leaves, size_t room) {
        if (leaves.empty()) return;  // its power is 0
        content_.nodes[node] = node_of(leaves);
        if (room == 1) {
            const PathLight& light = leaves.front().light;
            const size_t leaf = node - content_.lights.size();
            content_.lights[leaf] = record_of(light.record);
            if (light.area) content_.areas[leaf] = *light.area;
            return;
        }
        glm::dvec3 low(INFINITY), high(-INFINITY);
        for (const Leaf& leaf : leaves) {
            low = glm::min(low, leaf.metres);
            high = glm::max(high, leaf.metres);
        }
        const glm::dvec3 extent = high - low;
        int axis = extent.y > extent.x ? 1 : 0;
        if (extent.z > extent[axis]) axis = 2;
        std::ranges::stable_sort(leaves, {},
                                 [axis](const Leaf& leaf) { return leaf.metres[axis]; });
        const size_t half = (leaves.size() + 1) / 2;
        divide(2 * node, leaves.first(half), room / 2);
        divide(2 * node + 1, leaves.subspan(half), room / 2);
    }

    LightNode node_of(std::span<const Leaf> leaves) const {
        LightNode node{};
        glm::dvec3 low(INFINITY), high(-INFINITY), sum(0);
        double power = 0;
        for (const Leaf& leaf : leaves) {
            low = glm::min(low, leaf.metres);
            high = glm::max(high, leaf.metres);
            sum += vector_of(leaf.light.record.direction);
            power += leaf.share;
        }
        node.power = float(power);
        const glm::dvec3 middle = leaves.size() == 1 ? vector_of(leaves[0].light.record.position)
                                                     : 0.5 * (low + high) / edge_;
        const glm::vec3 stored(middle);
        double radius = 0;
        for (const Leaf& leaf : leaves) {
            const double aside = glm::distance(leaf.metres, glm::dvec3(stored) * edge_);
            radius = std::max(radius, leaf.radius + (leaves.size() == 1 ? 0 : aside));
        }
        node.radius = float(radius * (1 + kSlack));
        const double length = glm::length(sum);
        const glm::vec3 axis(length > 0 ? sum / length : glm::dvec3(0, 0, 1));
        node.cosine = length > 0 ? cone_of(leaves, glm::dvec3(axis)) : kEverywhere;
        for (int i = 0; i < 3; ++i) {
            node.middle[i] = stored[i];
            node.axis[i] = axis[i];
        }
        return node;
    }

    /// The cosine of the angle around `axis` within which all of the light is.
    static float cone_of(std::span<const Leaf> leaves, const glm::dvec3& axis) {
        double widest = 1;
        for (const Leaf& leaf : leaves) {
            const LightRecord& light = leaf.light.record;
            if (light.kind == VXL_LIGHT_POINT) return kEverywhere;
            const double aside = std::clamp(glm::dot(axis, vector_of(light.direction)), -1.0, 1.0);
            // Areas shine on the half of the space before them.
            const double half =
                leaf.light.area ? 0 : std::clamp(double(light.outer_cosine), -1.0, 1.0);
            if (aside <= -half + kSlack) return kEverywhere;  // the angles exceed 180 degrees
            const double sines = std::sqrt((1 - aside * aside) * (1 - half * half));
            widest = std::min(widest, aside * half - sines);
        }
        return float(widest - kSlack);
    }

    /// The light as a spot, unless it has an area: the cone of a point is wider than all
    /// directions.
    static LightRecord record_of(LightRecord light) {
        if (light.intensity.w != 0) light.intensity = {0, 0, 0, 0};
        if (light.kind != VXL_LIGHT_POINT) return light;
        light.kind = VXL_LIGHT_SPOT;
        light.direction = {0, 0, 1, 0};
        light.inner_cosine = -2;
        light.outer_cosine = -3;
        return light;
    }

    glm::dvec3 edge_;
    LightTreeContent content_;
    std::vector<Leaf> leaves_;
};

LightTree build_light_tree(const Device& device, std::span<const PathLight> lights,
                           const GridFrame& world) {
    const LightTreeContent content = light_tree_of(lights, world);
    LightTree tree = allocate_light_tree(device, lights.size(), lights.front().area.has_value());
    tree.lights.write(content.lights);
    if (tree.has_areas) tree.areas.write(content.areas);
    tree.nodes.write(content.nodes);
    return tree;
}

}  // namespace

LightTree allocate_light_tree(const Device& device, size_t count, bool has_areas) {
    const size_t leaves = leaves_for(count);
    const auto levels = uint32_t(std::countr_zero(leaves));
    return {{device, "lights", leaves},
            {device, "areas of lights", has_areas ? leaves : 1},
            {device, "tree of lights", 2 * leaves},
            levels,
            std::min<uint32_t>(levels, VXL_MOST_COMPARED_LEVEL),
            has_areas};
}

double light_tree_host_bytes(size_t count) {
    constexpr size_t kListed = 128;  // a scene's lights as global light samples them
    const size_t leaves = leaves_for(count);
    return double(leaves * (sizeof(LightRecord) + sizeof(LightAreaRecord) + 2 * sizeof(LightNode)) +
                  count * (sizeof(Leaf) + sizeof(PathLight) + kListed));
}

LightTreeContent light_tree_of(std::span<const PathLight> lights, const GridFrame& world) {
    return LightTreeMaker(lights, world).make();
}

LightTreeStage::LightTreeStage(const Device& device, const Features& features,
                               const Buffer<MaterialRecord>& materials,
                               std::span<const std::vector<PathLight>> lists,
                               const GridFrame& world)
    : materials_(materials),
      program_(device, "light_tree.cl", features.defines(device)),
      add_(program_.kernel("add_chosen_light")) {
    for (const std::vector<PathLight>& lights : lists)
        trees_.push_back(build_light_tree(device, lights, world));
}

void LightTreeStage::add(const Pyramid& pyramid, const LightTree& tree,
                         const PathSampling& sampling, RayBatch& batch, uint32_t count,
                         ShadowQueue& queue) {
    if (!queue.count.empty()) queue.count.fill(0);
    add_.launch_packets(count, pyramid, tree, sampling, materials_, queue, batch, count);
}

}  // namespace voxelume
