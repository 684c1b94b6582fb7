// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/gltf/gltf_skin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"
#include "runtime/io/gltf/gltf_accessor.hpp"
#include "runtime/io/gltf/gltf_primitives.hpp"

namespace voxelume {
namespace {

/// The number of pairs of JOINTS_n and WEIGHTS_n in a primitive.
size_t sets_of(const GltfValue& attributes) {
    size_t sets = 0;
    while (attributes.has(fmt::format("JOINTS_{}", sets).c_str()) &&
           attributes.has(fmt::format("WEIGHTS_{}", sets).c_str()))
        ++sets;
    return sets;
}

class WeightReader {
  public:
    WeightReader(const GltfFile& file, size_t joints) : file_(file), joints_(joints) {}

    SkinWeights read(const GltfValue& mesh) {
        size_t max_sets = 0;
        uint64_t vertices = 0;
        for (const GltfValue& primitive : gltf_primitives(mesh)) {
            max_sets = std::max(max_sets, sets_of(primitive.at("attributes")));
            vertices += count_gltf_values(file_, primitive.at("attributes"), "POSITION");
        }
        found_.per_vertex = 4 * max_sets;
        if (max_sets > 0 && vertices > kMaxSkinWeights / found_.per_vertex)
            throw Error(ErrorKind::limit,
                        "{}: {}: {} vertices with {} joints each; at most {} weights are read",
                        SourcePlace(file_.path().string()), mesh.place(), vertices,
                        found_.per_vertex, kMaxSkinWeights);
        found_.joints.resize(vertices * found_.per_vertex);
        found_.weights.resize(vertices * found_.per_vertex);
        for (const GltfValue& primitive : gltf_primitives(mesh)) add(primitive.at("attributes"));
        return std::move(found_);
    }

  private:
    void add(const GltfValue& attributes) {
        const uint64_t vertices = count_gltf_values(file_, attributes, "POSITION");
        for (size_t set = 0; set < sets_of(attributes); ++set) add_set(attributes, set, vertices);
        for (size_t i = base_; i < base_ + vertices; ++i) normalize(i * found_.per_vertex);
        base_ += vertices;
    }

    void add_set(const GltfValue& attributes, size_t set, uint64_t vertices) {
        const std::string joint_key = fmt::format("JOINTS_{}", set),
                          weight_key = fmt::format("WEIGHTS_{}", set);
        const GltfValues joints = gltf_values(file_, attributes, joint_key.c_str(), {4});
        const GltfValues weights = gltf_values(file_, attributes, weight_key.c_str(), {4});
        if (joints.count != vertices || weights.count != vertices)
            attributes.fail(fmt::format("{} vertices, {} of {} and {} of {}", vertices,
                                        joints.count, joint_key, weights.count, weight_key));
        for (size_t i = 0; i < 4 * vertices; ++i) {
            const float weight = weights.values[i], joint = joints.values[i];
            if (!(weight >= 0 && weight <= 1e6f))
                attributes.fail(fmt::format("{} is no weight", weight));
            if (weight > 0 && !(joint >= 0 && joint < float(joints_)))
                attributes.fail(fmt::format("names joint {}, and the skin has {}", joint, joints_));
            const size_t to = (base_ + i / 4) * found_.per_vertex + 4 * set + i % 4;
            found_.joints[to] = weight > 0 ? uint32_t(joint) : 0;
            found_.weights[to] = weight;
        }
    }

    void normalize(size_t first) {
        double sum = 0;
        for (size_t k = 0; k < found_.per_vertex; ++k) sum += double(found_.weights[first + k]);
        for (size_t k = 0; k < found_.per_vertex && sum > 0; ++k)
            found_.weights[first + k] = float(double(found_.weights[first + k]) / sum);
    }

    const GltfFile& file_;
    size_t joints_, base_ = 0;
    SkinWeights found_;
};

std::vector<int> joints_of(const GltfFile& file, const GltfValue& skin) {
    std::vector<int> joints;
    std::vector<bool> is_joint(file.root().size("nodes"));
    const auto nodes = double(is_joint.size());
    for (const GltfValue& item : skin.items("joints")) {
        const double number = item.json().is_number() ? item.json().get<double>() : -1;
        if (!(number >= 0 && number < nodes) || number != std::floor(number))
            item.fail("is the number of no node");
        if (is_joint[size_t(number)]) item.fail("is a joint of this skin already");
        is_joint[size_t(number)] = true;
        joints.push_back(int(number));
    }
    return joints;
}

std::vector<glm::dmat4> inverse_binds_of(const GltfFile& file, const GltfValue& skin,
                                         size_t joints) {
    std::vector<glm::dmat4> maps(joints, glm::dmat4(1));
    if (!skin.has("inverseBindMatrices")) return maps;
    const GltfValues values = gltf_values(file, skin, "inverseBindMatrices", {16});
    if (values.count < joints)
        skin.fail(fmt::format("{} joints and {} matrices", joints, values.count));
    for (size_t i = 0; i < joints; ++i) {
        maps[i] = glm::dmat4(glm::make_mat4(&values.values[16 * i]));
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                if (!std::isfinite(maps[i][column][row])) skin.fail("a matrix isn't finite");
    }
    return maps;
}

/// The box of the vertices that follow each joint, and last the box of vertices that none moves.
std::vector<Bounds> boxes_of(const GltfFile& file, const GltfValue& mesh,
                             const SkinWeights& weights, size_t joints) {
    std::vector<Bounds> boxes(joints + 1, {glm::dvec3(INFINITY), glm::dvec3(-INFINITY)});
    const auto add = [&](Bounds& box, const glm::dvec3& p) {
        box = {glm::min(box.min, p), glm::max(box.max, p)};
    };
    size_t first = 0;
    for (const GltfValue& primitive : gltf_primitives(mesh)) {
        const GltfValues at = gltf_values(file, primitive.at("attributes"), "POSITION", {3});
        for (size_t i = 0; i < at.count; ++i, first += weights.per_vertex) {
            const glm::dvec3 p(at.values[3 * i], at.values[3 * i + 1], at.values[3 * i + 2]);
            bool follows = false;
            for (size_t k = first; k < first + weights.per_vertex; ++k) {
                if (!(weights.weights[k] > 0)) continue;
                add(boxes[weights.joints[k]], p);
                follows = true;
            }
            if (!follows) add(boxes.back(), p);
        }
    }
    return boxes;
}

GltfValue skin_of(const GltfFile& file, int number) {
    if (size_t(number) >= file.root().size("skins"))
        throw Error(ErrorKind::input, "{}: has {} skins, and none of number {}",
                    SourcePlace(file.path().string()), file.root().size("skins"), number + 1);
    return file.root().item("skins", size_t(number));
}

glm::vec3 turned(const glm::dmat4& map, const glm::vec3& normal) {
    const glm::vec3 n(glm::inverseTranspose(glm::dmat3(map)) * glm::dvec3(normal));
    return std::isfinite(n.x + n.y + n.z) ? n : glm::vec3(0);
}

}  // namespace

GltfClip gltf_clip_named(const GltfFile& file, const std::string& name) {
    if (name.empty()) return {};
    const std::vector<std::string> names = gltf_clip_names(file);
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return gltf_clip(file, size_t(found - names.begin()));
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw Error(ErrorKind::input, "{}: has no clip {}{}", SourcePlace(file.path().string()),
                quote(name), known.empty() ? "; nothing in it moves" : suggest(name, known));
}

GltfSkin::GltfSkin(const GltfFile& file, int part, int number, const std::string& clip)
    : clip_(gltf_clip_named(file, clip)), motion_(file, clip_) {
    const GltfValue skin = skin_of(file, number);
    joints_ = joints_of(file, skin);
    inverse_binds_ = inverse_binds_of(file, skin, joints_.size());
    weights_ =
        WeightReader(file, joints_.size()).read(file.root().item("meshes", size_t(part - 1)));
    boxes_ = boxes_of(file, file.root().item("meshes", size_t(part - 1)), weights_, joints_.size());
}

std::vector<glm::dmat4> GltfSkin::maps_at(double seconds) const {
    std::vector<glm::dmat4> maps;
    GltfNode node;
    for (size_t i = 0; i < joints_.size(); ++i) {
        node.number = joints_[i];
        maps.push_back(motion_.world_from_node(node, seconds) * inverse_binds_[i]);
    }
    return maps;
}

void GltfSkin::move(Mesh& mesh, size_t first, double seconds) const {
    const std::vector<glm::dmat4> maps = maps_at(seconds);
    const size_t each = weights_.per_vertex;
    const bool has_normals = mesh.triangle_normals.empty();
    for (size_t i = 0; each > 0 && i < weights_.weights.size() / each; ++i) {
        glm::dmat4 map(0);
        double sum = 0;
        for (size_t k = i * each; k < (i + 1) * each; ++k) {
            const auto weight = double(weights_.weights[k]);
            if (weight == 0) continue;
            map += weight * maps[weights_.joints[k]];
            sum += weight;
        }
        if (sum == 0) continue;
        glm::vec3& p = mesh.positions[first + i];
        p = glm::vec3(map * glm::dvec4(p, 1));
        if (has_normals && first + i < mesh.normals.size())
            mesh.normals[first + i] = turned(map, mesh.normals[first + i]);
    }
}

Bounds GltfSkin::box_at(double seconds, const Bounds& slack) const {
    std::vector<glm::dmat4> maps = maps_at(seconds);
    maps.emplace_back(1);
    Bounds reached{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
    for (size_t joint = 0; joint < maps.size(); ++joint) {
        const Bounds& box = boxes_[joint];
        if (box.min.x > box.max.x) continue;
        for (int i = 0; i < 8; ++i) {
            const Bounds moved{box.min + slack.min, box.max + slack.max};
            const glm::dvec3 p(maps[joint] * glm::dvec4(corner(moved, i), 1));
            reached = {glm::min(reached.min, p), glm::max(reached.max, p)};
        }
    }
    return reached;
}

}  // namespace voxelume
