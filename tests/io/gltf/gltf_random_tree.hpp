// SPDX-License-Identifier: Apache-2.0
// A glTF file of nodes that a clip moves, and the nodes' positions, evaluated as the format
// defines.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/support/writers/gltf_writer.hpp"

namespace voxelume {

using Numbers = std::vector<double>;
using Matrix4 = std::array<Numbers, 4>;  ///< rows

inline Matrix4 identity_rows() {
    return {Numbers{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
}

inline Matrix4 product_of_rows(const Matrix4& a, const Matrix4& b) {
    Matrix4 c{Numbers(4), Numbers(4), Numbers(4), Numbers(4)};
    for (size_t i = 0; i < 4; ++i)
        for (size_t j = 0; j < 4; ++j)
            for (size_t k = 0; k < 4; ++k) c[i][j] += a[i][k] * b[k][j];
    return c;
}

inline Numbers unit_length(Numbers q) {
    double sum = 0;
    for (const double v : q) sum += v * v;
    for (double& v : q) v /= std::sqrt(sum);
    return q;
}

inline Matrix4 rows_of(const Numbers& t, const Numbers& rotation, const Numbers& s) {
    const Numbers q = unit_length(rotation);
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    return {Numbers{s[0] * (1 - 2 * (y * y + z * z)), s[1] * 2 * (x * y - z * w),
                    s[2] * 2 * (x * z + y * w), t[0]},
            {s[0] * 2 * (x * y + z * w), s[1] * (1 - 2 * (x * x + z * z)),
             s[2] * 2 * (y * z - x * w), t[1]},
            {s[0] * 2 * (x * z - y * w), s[1] * 2 * (y * z + x * w),
             s[2] * (1 - 2 * (x * x + y * y)), t[2]},
            {0, 0, 0, 1}};
}

/// The values of a sampler as the format defines them.
struct TestSampler {
    std::string interpolation;
    std::vector<float> times;
    std::vector<float> values;
    size_t width = 3;

    Numbers part(size_t key, size_t which) const {
        const size_t parts = interpolation == "CUBICSPLINE" ? 3 : 1;
        const auto first =
            values.begin() + std::ptrdiff_t((key * parts + (parts == 3 ? which : 0)) * width);
        return {first, first + std::ptrdiff_t(width)};
    }

    Numbers at(double time) const {
        if (time <= times.front()) return part(0, 1);
        if (time >= times.back()) return part(times.size() - 1, 1);
        size_t key = 0;
        while (times[key + 1] <= time) ++key;
        const Numbers a = part(key, 1), b = part(key + 1, 1);
        if (interpolation == "STEP") return a;
        const double span = double(times[key + 1]) - double(times[key]);
        const double u = (time - times[key]) / span;
        if (interpolation == "CUBICSPLINE") {
            const Numbers out = part(key, 2), in = part(key + 1, 0);
            Numbers row(width);
            for (size_t i = 0; i < width; ++i)
                row[i] = (2 * u * u * u - 3 * u * u + 1) * a[i] +
                         span * (u * u * u - 2 * u * u + u) * out[i] +
                         (-2 * u * u * u + 3 * u * u) * b[i] + span * (u * u * u - u * u) * in[i];
            return row;
        }
        return width == 4 ? spherical(unit_length(a), unit_length(b), u) : mixed(a, b, 1 - u, u);
    }

    static Numbers mixed(const Numbers& a, const Numbers& b, double p, double q) {
        Numbers row(a.size());
        for (size_t i = 0; i < a.size(); ++i) row[i] = p * a[i] + q * b[i];
        return row;
    }

    static Numbers spherical(const Numbers& a, const Numbers& b, double u) {
        double dot = 0;
        for (size_t i = 0; i < 4; ++i) dot += a[i] * b[i];
        const double sign = dot < 0 ? -1 : 1, angle = std::acos(std::min(std::abs(dot), 1.0));
        if (angle < 1e-9) return a;
        return mixed(a, b, std::sin((1 - u) * angle) / std::sin(angle),
                     sign * std::sin(u * angle) / std::sin(angle));
    }
};

/// A tree of nodes that all show a triangle, with random places and samplers.
class RandomTree {
  public:
    explicit RandomTree(unsigned seed) : random_(seed) {
        writer_.json["nodes"] = nlohmann::json::array();
        writer_.json["scenes"][0]["nodes"] = {0};
        for (int i = 0; i < kNodes; ++i) add_node(i);
        writer_.json["animations"][0]["name"] = "dance";
        for (int i = 0; i < kNodes; ++i) add_samplers(i);
    }

    const GltfWriter& writer() const { return writer_; }

    Matrix4 world_rows(int node, double time) const {
        Matrix4 map = identity_rows();
        for (; node >= 0; node = parents_[size_t(node)])
            map = product_of_rows(local_rows(size_t(node), time), map);
        return map;
    }

    static constexpr int kNodes = 24;

  private:
    float number(double minimum, double maximum) {
        return float(std::uniform_real_distribution<double>(minimum, maximum)(random_));
    }
    int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

    void add_node(int i) {
        nlohmann::json node = {{"mesh", 0}, {"name", "node " + std::to_string(i)}};
        parents_.push_back(i == 0 ? -1 : below(i));
        if (i > 0) writer_.json["nodes"][size_t(parents_.back())]["children"].push_back(i);
        still_.push_back({Numbers{0, 0, 0}, Numbers{0, 0, 0, 1}, Numbers{1, 1, 1}});
        if (i % 3 != 1) {
            for (double& v : still_.back()[0]) v = number(-2, 2);
            for (double& v : still_.back()[1]) v = number(-1, 1);
            for (double& v : still_.back()[2]) v = number(0.6, 1.3);
            node["translation"] = still_.back()[0];
            node["rotation"] = still_.back()[1];
            node["scale"] = still_.back()[2];
        }
        writer_.json["nodes"].push_back(node);
    }

    void add_samplers(int i) {
        constexpr std::array kPaths = {"translation", "rotation", "scale"};
        samplers_.emplace_back();
        for (size_t path = 0; path < 3; ++path) {
            if (below(3) == 0 || i % 5 == 4) continue;
            const TestSampler sampler = random_sampler(path);
            samplers_.back()[path] = sampler;
            nlohmann::json& animation = writer_.json["animations"][0];
            const int input = writer_.accessor(sampler.times, "SCALAR", 1);
            const int output =
                writer_.accessor(sampler.values, path == 1 ? "VEC4" : "VEC3", int(sampler.width));
            animation["channels"].push_back({{"sampler", animation["samplers"].size()},
                                             {"target", {{"node", i}, {"path", kPaths[path]}}}});
            animation["samplers"].push_back(
                {{"input", input}, {"output", output}, {"interpolation", sampler.interpolation}});
        }
    }

    TestSampler random_sampler(size_t path) {
        constexpr std::array kKinds = {"STEP", "LINEAR", "CUBICSPLINE"};
        TestSampler sampler{kKinds[size_t(below(3))], {number(0, 0.5)}, {}, path == 1 ? 4U : 3U};
        const int keys = 2 + below(6);
        while (int(sampler.times.size()) < keys)
            sampler.times.push_back(sampler.times.back() + number(0.1, 1.2));
        for (int key = 0; key < keys; ++key) {
            const bool is_spline = sampler.interpolation == "CUBICSPLINE";
            for (int part = is_spline ? 0 : 1; part < (is_spline ? 3 : 2); ++part)
                for (size_t c = 0; c < sampler.width; ++c)
                    sampler.values.push_back(part != 1   ? number(-0.1, 0.1)
                                             : path == 2 ? number(0.6, 1.4)
                                                         : number(-1, 1));
        }
        return sampler;
    }

    Matrix4 local_rows(size_t node, double time) const {
        std::array<Numbers, 3> values = still_[node];
        for (size_t path = 0; path < 3; ++path)
            if (!samplers_[node][path].times.empty()) values[path] = samplers_[node][path].at(time);
        return rows_of(values[0], values[1], values[2]);
    }

    std::mt19937 random_;
    GltfWriter writer_ = triangle_gltf();
    std::vector<int> parents_;
    std::vector<std::array<Numbers, 3>> still_;
    std::vector<std::array<TestSampler, 3>> samplers_;
};

}  // namespace voxelume
