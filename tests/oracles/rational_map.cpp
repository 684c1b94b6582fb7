// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/rational_map.hpp"

#include <stdexcept>

namespace voxelume::oracle {

RationalPoint rational_point(const glm::dvec3& p) {
    return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)};
}

RationalPoint RationalMap::operator*(const RationalPoint& p) const {
    RationalPoint q;
    for (size_t row = 0; row < 3; ++row)
        q[row] =
            linear[row][0] * p[0] + linear[row][1] * p[1] + linear[row][2] * p[2] + offset[row];
    return q;
}

RationalMap RationalMap::operator*(const RationalMap& inner) const {
    RationalMap product;
    product.offset = *this * inner.offset;
    for (size_t row = 0; row < 3; ++row)
        for (size_t column = 0; column < 3; ++column) {
            product.linear[row][column] = 0;
            for (size_t i = 0; i < 3; ++i)
                product.linear[row][column] += linear[row][i] * inner.linear[i][column];
        }
    return product;
}

RationalMap rational_map(const glm::dmat4& m) {
    RationalMap map;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            map.linear[size_t(row)][size_t(column)] = m[column][row];
        map.offset[size_t(row)] = m[3][row];
    }
    return map;
}

RationalMap rational_turn(int a, int b, int c, int d) {
    const mpq_class n(a * a + b * b + c * c + d * d);
    // The image of v is q v q* / n, written out for the three unit vectors.
    RationalMap turn;
    turn.linear[0] = {mpq_class(a * a + b * b - c * c - d * d) / n,
                      mpq_class(2 * (b * c - a * d)) / n, mpq_class(2 * (b * d + a * c)) / n};
    turn.linear[1] = {mpq_class(2 * (b * c + a * d)) / n,
                      mpq_class(a * a - b * b + c * c - d * d) / n,
                      mpq_class(2 * (c * d - a * b)) / n};
    turn.linear[2] = {mpq_class(2 * (b * d - a * c)) / n, mpq_class(2 * (c * d + a * b)) / n,
                      mpq_class(a * a - b * b - c * c + d * d) / n};
    return turn;
}

RationalMap inverse(const RationalMap& map) {
    const auto& m = map.linear;
    RationalMap result;
    for (size_t row = 0; row < 3; ++row)
        for (size_t column = 0; column < 3; ++column) {
            const size_t r1 = (column + 1) % 3, r2 = (column + 2) % 3;
            const size_t c1 = (row + 1) % 3, c2 = (row + 2) % 3;
            result.linear[row][column] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
        }
    const mpq_class determinant = m[0][0] * result.linear[0][0] + m[0][1] * result.linear[1][0] +
                                  m[0][2] * result.linear[2][0];
    if (determinant == 0) throw std::invalid_argument("a map without an inverse");
    for (RationalPoint& row : result.linear)
        for (mpq_class& entry : row) entry /= determinant;
    const RationalPoint moved = result * map.offset;  // its own offset is still 0
    for (size_t a = 0; a < 3; ++a) result.offset[a] = -moved[a];
    return result;
}

}  // namespace voxelume::oracle
