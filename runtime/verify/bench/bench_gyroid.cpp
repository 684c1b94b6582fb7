// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/bench_gyroid.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <memory>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/base/files/temporary_folder.hpp"

namespace voxelume {
namespace {

constexpr double kWave = 4 * 3.14159265358979323846;  // 2 pi over the period, per metre
constexpr double kRadius = 0.45;                      // metres
constexpr double kReach = 0.46;                       // in metres; the field is positive from there
                                                      // on

/// An upper bound of the gradient's length inside `kReach`: sqrt(3) kWave for the waves, the rest
/// for the ball.
constexpr double kSteepest = 22 + 45;

/// Triangles of 6 mm, which lie within 1e-4 m of the surface.
constexpr int kCells = 150;

/// Computes the field at a lattice's points, and the mesh's vertices on the edges between them.
class TetrahedraMarch {
  public:
    explicit TetrahedraMarch(int cells) : points_(cells + 1), step_(2 * kReach / cells) {
        values_.reserve(size_t(points_) * size_t(points_) * size_t(points_));
        for (int z = 0; z < points_; ++z)
            for (int y = 0; y < points_; ++y)
                for (int x = 0; x < points_; ++x)
                    values_.push_back(gyroid_value(position(number({x, y, z}))));
    }

    Mesh mesh() {
        for (int z = 0; z + 1 < points_; ++z)
            for (int y = 0; y + 1 < points_; ++y)
                for (int x = 0; x + 1 < points_; ++x) add_cube({x, y, z});
        return std::move(mesh_);
    }

  private:
    uint32_t number(const glm::ivec3& p) const {
        return uint32_t((p.z * points_ + p.y) * points_ + p.x);
    }

    glm::dvec3 position(uint32_t number) const {
        const int n = int(number);
        const glm::dvec3 index(n % points_, n / points_ % points_, n / points_ / points_);
        return index * step_ - kReach;
    }

    /// Adds six tetrahedra around the diagonal, one for each order in which the axes are walked.
    void add_cube(const glm::ivec3& corner) {
        constexpr std::array<std::array<int, 3>, 6> kOrders = {
            {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
        for (const auto& order : kOrders) {
            glm::ivec3 p = corner;
            std::array<uint32_t, 4> at{number(p)};
            for (size_t i = 0; i < 3; ++i) ++p[order[i]], at[i + 1] = number(p);
            add_tetrahedron(at);
        }
    }

    void add_tetrahedron(const std::array<uint32_t, 4>& at) {
        std::array<uint32_t, 4> in{}, out{};
        size_t ins = 0, outs = 0;
        for (const uint32_t corner : at) (values_[corner] < 0 ? in[ins++] : out[outs++]) = corner;
        if (ins == 1)
            add(in[0], {vertex(in[0], out[0]), vertex(in[0], out[1]), vertex(in[0], out[2])});
        if (outs == 1)
            add(in[0], {vertex(in[0], out[0]), vertex(in[1], out[0]), vertex(in[2], out[0])});
        if (ins != 2 || outs != 2) return;
        const uint32_t a = vertex(in[0], out[0]), b = vertex(in[0], out[1]);
        const uint32_t c = vertex(in[1], out[1]), d = vertex(in[1], out[0]);
        add(in[0], {a, b, c});
        add(in[0], {a, c, d});
    }

    /// Adds a triangle that faces away from a point inside.
    void add(uint32_t inside, glm::uvec3 triangle) {
        const auto corner = [&](int i) { return glm::dvec3(mesh_.positions[triangle[i]]); };
        const glm::dvec3 normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
        if (glm::dot(normal, position(inside) - corner(0)) > 0) std::swap(triangle.y, triangle.z);
        mesh_.triangles.push_back(triangle);
    }

    uint32_t vertex(uint32_t inside, uint32_t outside) {
        const auto [found, is_new] =
            vertices_.try_emplace({inside, outside}, uint32_t(mesh_.positions.size()));
        if (is_new) {
            glm::dvec3 a = position(inside), b = position(outside);
            for (int i = 0; i < 30; ++i) {
                const glm::dvec3 middle = (a + b) / 2.0;
                (gyroid_value(middle) < 0 ? a : b) = middle;
            }
            mesh_.positions.emplace_back(a);
        }
        return found->second;
    }

    int points_;
    double step_;
    std::vector<double> values_;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> vertices_;
    Mesh mesh_;
};

/// A mesh as binary PLY. The file is removed with its last owner.
class TemporaryMesh {
  public:
    explicit TemporaryMesh(const Mesh& mesh) {
        std::string bytes = fmt::format(
            "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty "
            "float y\nproperty float z\nelement face {}\nproperty list uchar uint "
            "vertex_indices\nend_header\n",
            mesh.positions.size(), mesh.triangles.size());
        for (const glm::vec3& p : mesh.positions)
            bytes.append(reinterpret_cast<const char*>(&p), sizeof p);
        for (const glm::uvec3& t : mesh.triangles) {
            bytes += '\3';
            bytes.append(reinterpret_cast<const char*>(&t), sizeof t);
        }
        AtomicFile file(path().string());
        file.write(bytes.data(), bytes.size());
        file.commit();
    }

    std::filesystem::path path() const { return folder_.path() / "gyroid.ply"; }

  private:
    TemporaryFolder folder_;
};

/// The part of a ray inside the ball that contains the surface; empty if `first` > `last`.
struct Part {
    double first, last;
};

Part part_in_ball(const glm::dvec3& origin, const glm::dvec3& direction) {
    const double nearest = -glm::dot(origin, direction);
    const glm::dvec3 across = origin + nearest * direction;
    const double square = kReach * kReach - glm::dot(across, across);
    if (square < 0) return {1, 0};
    return {std::max(0.0, nearest - std::sqrt(square)), nearest + std::sqrt(square)};
}

}  // namespace

double gyroid_value(const glm::dvec3& p) {
    const glm::dvec3 s = glm::sin(kWave * p), c = glm::cos(kWave * p);
    const double square = glm::dot(p, p) / (kRadius * kRadius);
    return s.x * c.y + s.y * c.z + s.z * c.x + 2 * square * square * square * square;
}

glm::dvec3 gyroid_gradient(const glm::dvec3& p) {
    const glm::dvec3 s = glm::sin(kWave * p), c = glm::cos(kWave * p);
    const double square = glm::dot(p, p) / (kRadius * kRadius);
    return kWave * glm::dvec3(c.x * c.y - s.z * s.x, c.y * c.z - s.x * s.y, c.z * c.x - s.y * s.z) +
           16 * square * square * square / (kRadius * kRadius) * p;
}

std::optional<AnalyticHit> gyroid_hit(const glm::dvec3& origin, const glm::dvec3& direction) {
    constexpr double kMinStep = 1e-6;  // metres
    const Part part = part_in_ball(origin, direction);
    const auto value = [&](double t) { return gyroid_value(origin + t * direction); };
    double before = part.first;
    for (double t = part.first; t <= part.last;) {
        const double now = value(t);
        if (now < 0) {
            double low = before, high = t;
            for (double middle = low + (high - low) / 2; middle > low && middle < high;
                 middle = low + (high - low) / 2)
                (value(middle) < 0 ? high : low) = middle;
            return AnalyticHit{high, glm::normalize(gyroid_gradient(origin + high * direction))};
        }
        before = t;
        t += std::max(now / kSteepest, kMinStep);
    }
    return {};
}

Mesh gyroid_mesh(int cells) {
    return TetrahedraMarch(cells).mesh();
}

BenchSubject gyroid_subject() {
    const auto mesh = std::make_shared<const TemporaryMesh>(gyroid_mesh(kCells));
    BenchSubject subject;
    subject.name = "gyroid";
    subject.min_radius = 0.022;
    subject.scene = [mesh](Surface surface, int resolution, glm::ivec2 size) {
        Scene scene = empty_bench_scene(resolution, size);
        Model model;
        model.name = "gyroid";
        model.mesh = mesh->path();
        add_bench_object(scene, std::move(model), surface, resolution, glm::dmat4(1));
        return scene;
    };
    subject.first_hit = gyroid_hit;
    // The extent is extrapolated from gyroid_mesh(150), (300) and (450). The last two steps agree
    // in these digits.
    subject.extent = Extent{0.1243275, 2.299671};
    return subject;
}

}  // namespace voxelume
