// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/gltf/gltf_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>

#include "runtime/base/error.hpp"
#include "runtime/io/gltf/gltf_accessor.hpp"
#include "runtime/io/gltf/gltf_primitives.hpp"

namespace voxelume {
namespace {

glm::dmat4 map_of(const glm::dvec3& translation, const glm::dvec4& rotation,
                  const glm::dvec3& scale) {
    const double length = glm::length(rotation);
    glm::dmat4 map(1);
    if (length > 0) {
        const glm::dvec4 q = rotation / length;
        map = glm::mat4_cast(glm::dquat(q.w, q.x, q.y, q.z));
    }
    for (int axis = 0; axis < 3; ++axis) map[axis] *= scale[axis];
    map[3] = glm::dvec4(translation, 1);
    return map;
}

/// The values of a member, or default ones where there is none.
template <int Size>
glm::vec<Size, double> vector_of(const GltfValue& value, const char* key,
                                 const glm::vec<Size, double>& otherwise) {
    const std::vector<double> numbers = value.numbers(key, Size);
    glm::vec<Size, double> vector = otherwise;
    for (size_t i = 0; i < numbers.size(); ++i) vector[int(i)] = numbers[i];
    return vector;
}

/// The maps of EXT_mesh_gpu_instancing; the identity alone without it.
std::vector<glm::dmat4> instances_of(const GltfFile& file, const GltfValue& node) {
    if (!node.has_extension("EXT_mesh_gpu_instancing")) return {glm::dmat4(1)};
    const GltfValue attributes = node.extension("EXT_mesh_gpu_instancing").at("attributes");
    const auto read = [&](const char* key, int components) {
        return attributes.has(key) ? gltf_values(file, attributes, key, {components})
                                   : GltfValues{};
    };
    const GltfValues translations = read("TRANSLATION", 3), turns = read("ROTATION", 4),
                     scales = read("SCALE", 3);
    const uint64_t count = std::max({translations.count, turns.count, scales.count});
    if (count > kMaxGltfNodes)
        throw Error(ErrorKind::limit, "{}: {}: {} instances; at most {} are read",
                    SourcePlace(file.path().string()), node.place(), count, kMaxGltfNodes);
    std::vector<glm::dmat4> maps;
    for (size_t i = 0; i < count; ++i) {
        glm::dvec3 translation(0), scale(1);
        glm::dvec4 turn(0, 0, 0, 1);
        for (int c = 0; c < 4; ++c) {
            const size_t c3 = 3 * i + size_t(c), c4 = 4 * i + size_t(c);
            if (i < turns.count) turn[c] = double(turns.values[c4]);
            if (c == 3) continue;
            if (i < translations.count) translation[c] = double(translations.values[c3]);
            if (i < scales.count) scale[c] = double(scales.values[c3]);
        }
        maps.push_back(map_of(translation, turn, scale));
    }
    return maps;
}

/// Walks the trees of nodes without recursion.
class Walk {
  public:
    explicit Walk(const GltfFile& file)
        : file_(file),
          root_(file.root()),
          lights_(gltf_lights(file).size()),
          seen_(root_.size("nodes")),
          parents_(seen_.size(), -1) {}

    std::vector<GltfNode> nodes() {
        for (const int number : roots()) open_.push_back({number, glm::dmat4(1)});
        std::reverse(open_.begin(), open_.end());
        while (!open_.empty()) {
            const auto [number, parent] = open_.back();
            open_.pop_back();
            visit(number, parent);
        }
        return std::move(found_);
    }

    std::vector<int> parents() {
        nodes();
        return std::move(parents_);
    }

  private:
    /// The numbers in a list of nodes.
    std::vector<int> numbers(const GltfValue& from, const char* key) const {
        std::vector<int> list;
        for (const GltfValue& item : from.items(key)) {
            const double value = item.json().is_number() ? item.json().get<double>() : -1;
            if (!(value >= 0 && value < double(seen_.size())) || value != double(int(value)))
                item.fail("is the number of no node");
            list.push_back(int(value));
        }
        return list;
    }

    std::vector<int> roots() const {
        const size_t scenes = root_.size("scenes");
        const int chosen = std::max(root_.index("scene", scenes), 0);
        if (scenes > 0) return numbers(root_.item("scenes", size_t(chosen)), "nodes");
        std::vector<char> is_child(seen_.size());
        for (const GltfValue& node : root_.items("nodes"))
            for (const int child : numbers(node, "children")) is_child[size_t(child)] = 1;
        std::vector<int> list;
        for (size_t i = 0; i < is_child.size(); ++i)
            if (!is_child[i]) list.push_back(int(i));
        return list;
    }

    void visit(int number, const glm::dmat4& world_from_parent) {
        const GltfValue node = root_.item("nodes", size_t(number));
        if (seen_[size_t(number)]++) node.fail("is a child of two nodes, or of one below itself");
        const glm::dmat4 world_from_node = world_from_parent * gltf_parent_from_node(node);
        std::vector<int> children = numbers(node, "children");
        for (auto child = children.rbegin(); child != children.rend(); ++child) {
            open_.push_back({*child, world_from_node});
            parents_[size_t(*child)] = number;
        }
        GltfNode found;
        found.number = number;
        found.mesh = node.index("mesh", root_.size("meshes"));
        found.camera = node.index("camera", root_.size("cameras"));
        found.light = node.extension("KHR_lights_punctual").index("light", lights_);
        if (found.mesh >= 0 && node.has("skin") && has_joints(found.mesh))
            found.skin = node.index("skin", root_.size("skins"));
        if (found.mesh < 0 && found.camera < 0 && found.light < 0) return;
        found.name = node.text("name");
        for (const glm::dmat4& map : instances_of(file_, node)) {
            found.world_from_node = world_from_node * map;
            found.node_from_instance = map;
            add(found);
            found.camera = found.light = -1;
        }
    }

    /// True if a mesh has joints; each mesh is asked once, however many nodes show it.
    bool has_joints(int mesh) {
        const auto [known, is_new] = joints_.try_emplace(mesh, false);
        if (is_new) known->second = has_gltf_joints(root_.item("meshes", size_t(mesh)));
        return known->second;
    }

    void add(const GltfNode& found) {
        if (found_.size() == kMaxGltfNodes)
            throw Error(ErrorKind::limit, "{}: more than {} nodes with something to show",
                        SourcePlace(file_.path().string()), kMaxGltfNodes);
        found_.push_back(found);
    }

    struct Open {
        int number;
        glm::dmat4 world_from_parent;
    };

    const GltfFile& file_;
    GltfValue root_;
    size_t lights_;
    std::vector<char> seen_;
    std::vector<int> parents_;
    std::vector<Open> open_;
    std::map<int, bool> joints_;
    std::vector<GltfNode> found_;
};

}  // namespace

std::vector<GltfValue> gltf_lights(const GltfFile& file) {
    return file.root().extension("KHR_lights_punctual").items("lights");
}

bool has_gltf_joints(const GltfValue& mesh) {
    return std::ranges::any_of(gltf_primitives(mesh), [](const GltfValue& primitive) {
        const GltfValue attributes = primitive.at("attributes");
        return attributes.has("JOINTS_0") && attributes.has("WEIGHTS_0");
    });
}

std::vector<GltfNode> gltf_nodes(const GltfFile& file) {
    return Walk(file).nodes();
}

std::vector<int> gltf_parents(const GltfFile& file) {
    return Walk(file).parents();
}

glm::dvec3 gltf_translation(const GltfValue& node) {
    return vector_of<3>(node, "translation", glm::dvec3(0));
}

glm::dvec4 gltf_rotation(const GltfValue& node) {
    return vector_of<4>(node, "rotation", glm::dvec4(0, 0, 0, 1));
}

glm::dvec3 gltf_scale(const GltfValue& node) {
    return vector_of<3>(node, "scale", glm::dvec3(1));
}

glm::dmat4 gltf_parent_from_node(const GltfValue& node) {
    const std::vector<double> matrix = node.numbers("matrix", 16);
    if (matrix.empty())
        return map_of(gltf_translation(node), gltf_rotation(node), gltf_scale(node));
    glm::dmat4 map = glm::make_mat4(matrix.data());
    for (int column = 0; column < 4; ++column)
        if (map[column].w != (column == 3 ? 1.0 : 0.0))
            node.fail("its matrix isn't that of an affine map");
    return map;
}

}  // namespace voxelume
