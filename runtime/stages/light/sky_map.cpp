// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/sky_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/io/image/sky_picture.hpp"

namespace voxelume {
namespace {

double luminance(const float* rgb) {
    return 0.2126 * double(rgb[0]) + 0.7152 * double(rgb[1]) + 0.0722 * double(rgb[2]);
}

/// The light of each texel of a row: its luminance, blended with an eighth of each neighbour's, as
/// linear interpolation between texels does.
std::vector<double> blurred_row(const SkyMapData& data, int y) {
    const auto width = size_t(data.width);
    const float* row = &data.texels[size_t(y) * width * 3];
    std::vector<double> result(width);
    for (size_t x = 0; x < width; ++x) {
        const size_t left = x == 0 ? width - 1 : x - 1, right = x + 1 == width ? 0 : x + 1;
        result[x] = 0.75 * luminance(row + 3 * x) +
                    0.125 * (luminance(row + 3 * left) + luminance(row + 3 * right));
    }
    return result;
}

/// Distributes values along an axis of the picture over `parts` equal parts, of which there are at
/// most as many as values.
template <class Add>
void share_out(size_t values, size_t parts, const Add& add) {
    for (size_t i = 0; i < values; ++i) {
        // In units of 1 / (values * parts), a value is `parts` long, and a part is `values` long.
        const size_t begin = i * parts, end = begin + parts;
        for (size_t part = begin / values; part * values < end; ++part) {
            const size_t common =
                std::min(end, (part + 1) * values) - std::max(begin, part * values);
            add(i, part, double(common) / double(parts));
        }
    }
}

/// The weights of a row of texels, of the one above and of the one below in the row's light:
/// integrals over the row of linear interpolation times the sine of the angle.
struct RowShares {
    double above, here, below;
};

RowShares row_shares(size_t y, size_t height) {
    const double step = std::numbers::pi / double(height);
    const double begin = step * double(y), middle = begin + step / 2, end = begin + step;
    const double above = std::cos(begin) / 2 + (std::sin(begin) - std::sin(middle)) / step;
    const double below = (std::sin(end) - std::sin(middle)) / step - std::cos(end) / 2;
    return {above, std::cos(begin) - std::cos(end) - above - below, below};
}

/// The light of each cell.
std::vector<double> light_of_cells(const SkyMapData& data) {
    const auto width = size_t(data.width), height = size_t(data.height);
    const auto columns = size_t(data.columns), rows = size_t(data.rows);
    std::vector<double> cells(columns * rows);
    std::vector<double> above = blurred_row(data, 0), here = above, sums(columns);
    size_t known = 0;
    share_out(height, rows, [&](size_t y, size_t row, double share) {
        if (y != known) above = std::exchange(here, blurred_row(data, int(y)));
        known = y;
        const std::vector<double> below = y + 1 == height ? here : blurred_row(data, int(y + 1));
        const RowShares shares = row_shares(y, height);
        std::ranges::fill(sums, 0.0);
        share_out(width, columns, [&](size_t x, size_t column, double part) {
            sums[column] +=
                part * (shares.above * above[x] + shares.here * here[x] + shares.below * below[x]);
        });
        for (size_t column = 0; column < columns; ++column)
            cells[row * columns + column] += share * sums[column];
    });
    return cells;
}

/// Divides [0, 1) into parts proportional to weights, each at least 2^-32, and writes the starts as
/// 32-bit fractions. Returns the parts.
std::vector<double> write_parts(std::span<const double> weights, uint32_t* starts) {
    constexpr double kAll = 4294967296.0;
    double sum = 0;
    for (const double weight : weights) sum += weight;
    const auto count = double(weights.size());
    std::vector<double> parts;
    parts.reserve(weights.size());
    double before = 0;
    uint64_t start = 0;
    for (size_t i = 0; i < weights.size(); ++i) {
        before += sum > 0 ? weights[i] / sum : 1 / count;
        const auto units = uint64_t(std::max(std::floor(before * (kAll - count)), 0.0));
        const uint64_t end = i + 1 == weights.size()
                                 ? uint64_t(kAll)
                                 : std::min(units, uint64_t(kAll - count)) + i + 1;
        starts[i] = uint32_t(start);
        parts.push_back(double(end - start) / kAll);
        start = end;
    }
    return parts;
}

std::shared_ptr<const SkyMapData> read_map(const Sky& sky) {
    auto data = std::make_shared<SkyMapData>();
    ColorPicture picture = read_sky_picture(sky.file, kMaxSkyPixels);
    data->width = picture.width;
    data->height = picture.height;
    data->texels = std::move(picture.values);
    make_sky_cells(*data);
    return data;
}

/// Calls a reader of the sky's file. Its messages then begin with the place of the file's name in
/// the text.
template <class Read>
auto with_place(const Sky& sky, const Read& read) {
    try {
        return read();
    } catch (const Error& error) {
        throw Error(error.kind(), "{}: {}", sky.where, error.what());
    }
}

size_t table_words(size_t columns, size_t rows) {
    return rows + 2 * columns * rows;
}

}  // namespace

void make_sky_cells(SkyMapData& data) {
    data.columns = std::min(data.width, VXL_SKY_MAX_CELLS);
    data.rows = std::min(data.height, VXL_SKY_MAX_CELLS / 2);
    const auto columns = size_t(data.columns), rows = size_t(data.rows);
    const std::vector<double> cells = light_of_cells(data);
    std::vector<double> sums;
    sums.reserve(rows);
    for (size_t row = 0; row < rows; ++row) {
        double sum = 0;
        for (size_t column = 0; column < columns; ++column) sum += cells[row * columns + column];
        sums.push_back(sum);
    }
    data.table.resize(table_words(columns, rows));
    const std::vector<double> row_parts = write_parts(sums, data.table.data());
    // A small piece of the picture has a solid angle of 2 pi^2 times its share of the picture's
    // area, times the sine of its angle from the zenith.
    const double per_part = double(columns * rows) / (2 * std::numbers::pi * std::numbers::pi);
    for (size_t row = 0; row < rows; ++row) {
        const std::span<const double> weights = std::span(cells).subspan(row * columns, columns);
        const size_t first = rows + row * columns;
        const std::vector<double> parts = write_parts(weights, &data.table[first]);
        for (size_t column = 0; column < columns; ++column)
            data.table[first + columns * rows + column] =
                std::bit_cast<uint32_t>(float(row_parts[row] * parts[column] * per_part));
    }
}

std::shared_ptr<const SkyMapData> sky_map_data(const Sky& sky) {
    SkyMapRoom& room = *sky.map.room;
    const std::scoped_lock lock(room.mutex);
    if (!room.data) room.data = with_place(sky, [&] { return read_map(sky); });
    return room.data;
}

SkyMap build_sky_map(const Device& device, const Sky& sky) {
    const std::shared_ptr<const SkyMapData> data = sky_map_data(sky);
    constexpr const char* kSmaller = "use a smaller picture of the sky";
    SkyMap map;
    map.is_used = true;
    map.record = {data->width, data->height,        data->columns, data->rows,
                  0,           float(sky.strength), 1.0f,          0};
    const double turns = sky.rotation / 360;
    map.record.turn = std::min(float(turns - std::floor(turns)), 0.99999994f);
    map.texels = Buffer<float>(device, "sky", data->texels.size(), kSmaller);
    map.texels.write(data->texels);
    map.table = Buffer<uint32_t>(device, "sky", data->table.size(), kSmaller);
    map.table.write(data->table);
    return map;
}

SkyMapBytes sky_map_bytes(const Sky& sky) {
    const glm::dvec2 size =
        with_place(sky, [&] { return sky_picture_size(sky.file, kMaxSkyPixels); });
    const double columns = std::min(size.x, double(VXL_SKY_MAX_CELLS));
    const double rows = std::min(size.y, VXL_SKY_MAX_CELLS / 2.0);
    SkyMapBytes bytes;
    bytes.texels = 12 * size.x * size.y;
    bytes.table = 4 * (rows + 2 * columns * rows);
    bytes.host = 2 * bytes.texels + bytes.table + 16 * columns * rows;
    return bytes;
}

}  // namespace voxelume
