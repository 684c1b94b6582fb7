// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/rational_solid.hpp"

#include <algorithm>
#include <cmath>

namespace voxelume::oracle {
namespace {

int sign_of(const mpq_class& value) {
    return sgn(value);
}

/// A number, and a bound on its error.
struct Rounded {
    long double value = 0, error = 0;

    Rounded(double exact) : value(exact) {}  // NOLINT: numbers of a solid are doubles
    Rounded(long double v, long double e) : value(v), error(e) {}

    friend Rounded operator+(const Rounded& a, const Rounded& b) {
        return widened(a.value + b.value, a.error + b.error);
    }
    friend Rounded operator-(const Rounded& a, const Rounded& b) {
        return widened(a.value - b.value, a.error + b.error);
    }
    friend Rounded operator*(const Rounded& a, const Rounded& b) {
        return widened(a.value * b.value, std::abs(a.value) * b.error +
                                              std::abs(b.value) * a.error + a.error * b.error);
    }

  private:
    static Rounded widened(long double value, long double error) {
        return {value, error * 1.0001L + std::abs(value) * 0x1p-62L};
    }
};

constexpr int kUnknown = 9;

int sign_of(const Rounded& a) {
    if (std::abs(a.value) <= 1e6L * a.error) return kUnknown;
    return a.value > 0 ? 1 : -1;
}

int max_side(std::initializer_list<int> sides) {
    return std::max(sides);  // kUnknown is greater than all others
}

/// The side of |a| <= edge / 2.
template <class Number>
int side_of_pair(const Number& a, double edge) {
    return sign_of(Number(a * a * Number(4.0) - Number(edge) * Number(edge)));
}

template <class Number>
int side_of_ball(const Number& squared, double radius) {
    return sign_of(Number(squared - Number(radius) * Number(radius)));
}

template <class Number>
int side_of_ellipsoid(const std::array<Number, 3>& p, const glm::dvec3& radii) {
    const Number a(radii.x), b(radii.y), c(radii.z);
    const Number x = p[0] * b * c, y = p[1] * a * c, z = p[2] * a * b, r = a * b * c;
    return sign_of(Number(x * x + y * y + z * z - r * r));
}

/// Between the planes at -h/2 and h/2, the radius changes from `radius` to `top_radius`. Multiplied
/// by 2h, it is r0 (h - 2y) + r1 (h + 2y).
template <class Number>
int side_of_cone(const std::array<Number, 3>& p, const Solid& s) {
    const Number h(s.height), two_y = p[1] * Number(2.0);
    const Number r = Number(s.radius) * (h - two_y) + Number(s.top_radius) * (h + two_y);
    const Number across = p[0] * p[0] + p[2] * p[2];
    return max_side(
        {side_of_pair(p[1], s.height), sign_of(Number(across * h * h * Number(4.0) - r * r))});
}

/// The torus is (x² + y² + z² + R² - r²)² = 4 R² (x² + z²).
template <class Number>
int side_of_torus(const std::array<Number, 3>& p, const Solid& s) {
    const Number ring(s.radius), tube(s.tube);
    const Number across = p[0] * p[0] + p[2] * p[2];
    const Number sum = across + p[1] * p[1] + ring * ring - tube * tube;
    return sign_of(Number(sum * sum - ring * ring * across * Number(4.0)));
}

template <class Number>
int side_of_capsule(const std::array<Number, 3>& p, const Solid& s) {
    const Number across = p[0] * p[0] + p[2] * p[2], half = Number(s.height) * Number(0.5);
    const Number up = p[1] - half, down = p[1] + half;
    const int above = sign_of(up), below = sign_of(down);
    if (above == kUnknown || below == kUnknown) return kUnknown;
    if (above > 0) return side_of_ball(Number(across + up * up), s.radius);
    if (below < 0) return side_of_ball(Number(across + down * down), s.radius);
    return side_of_ball(across, s.radius);
}

template <class Number>
int side_of_shape(const std::array<Number, 3>& p, const Solid& s) {
    const Number across = p[0] * p[0] + p[2] * p[2];
    switch (s.kind) {
        case SolidKind::ellipsoid:
            return side_of_ellipsoid(p, s.radii);
        case SolidKind::box:
            return max_side({side_of_pair(p[0], s.size.x), side_of_pair(p[1], s.size.y),
                             side_of_pair(p[2], s.size.z)});
        case SolidKind::cylinder:
            return max_side({side_of_pair(p[1], s.height), side_of_ball(across, s.radius)});
        case SolidKind::cone:
            return side_of_cone(p, s);
        case SolidKind::torus:
            return side_of_torus(p, s);
        case SolidKind::capsule:
            return side_of_capsule(p, s);
        case SolidKind::slab:
            return side_of_pair(p[1], s.thickness);
        default:
            return side_of_ball(Number(across + p[1] * p[1]), s.radius);
    }
}

/// A rational as a long double, with an error of at most half a unit in the last place.
long double rounded(const mpq_class& value) {
    const double high = value.get_d();
    const mpq_class rest = value - mpq_class(high);
    return static_cast<long double>(high) + static_cast<long double>(rest.get_d());
}

}  // namespace

RationalSolid::RationalSolid(const Solid& solid, const RationalMap& frame_from_solid)
    : solid_(solid) {
    const RationalMap frame_from_this = frame_from_solid * rational_map(solid.parent_from_solid);
    for (const Solid& part : solid.parts) parts_.emplace_back(part, frame_from_this);
    solid_.parts.clear();
    solid_from_frame_ = inverse(frame_from_this);
    for (size_t row = 0; row < 3; ++row) {
        for (size_t column = 0; column < 3; ++column)
            rounded_[3 * row + column] = rounded(solid_from_frame_.linear[row][column]);
        rounded_[9 + row] = rounded(solid_from_frame_.offset[row]);
    }
}

int RationalSolid::likely_side(const glm::dvec3& point) const {
    const auto entry = [](long double v) { return Rounded(v, std::abs(v) * 0x1p-62L); };
    std::array<Rounded, 3> p = {0.0, 0.0, 0.0};
    for (size_t row = 0; row < 3; ++row) {
        p[row] = entry(rounded_[9 + row]);
        for (size_t a = 0; a < 3; ++a)
            p[row] = p[row] + entry(rounded_[3 * row + a]) * Rounded(point[int(a)]);
    }
    return side_of_shape(p, solid_);
}

int RationalSolid::side(const glm::dvec3& point) const {
    if (!is_combination(solid_.kind)) {
        const int likely = likely_side(point);
        if (likely != kUnknown) return likely;
        return side_of_shape(solid_from_frame_ * rational_point(point), solid_);
    }
    int result = parts_[0].side(point);
    for (size_t i = 1; i < parts_.size(); ++i) {
        const int side = parts_[i].side(point);
        if (solid_.kind == SolidKind::union_of)
            result = std::min(result, side);
        else
            result = std::max(result, solid_.kind == SolidKind::difference_of ? -side : side);
    }
    return result;
}

}  // namespace voxelume::oracle
