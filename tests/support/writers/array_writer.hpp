// SPDX-License-Identifier: Apache-2.0
// Writes .npy, NRRD and NIfTI files according to their specifications, for tests of the readers.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <vector>

namespace voxelume {

template <class Value>
void append_value(std::string& bytes, Value value, bool is_big = false) {
    char raw[sizeof(Value)];
    std::memcpy(raw, &value, sizeof value);
    if (is_big) std::reverse(raw, raw + sizeof value);
    bytes.append(raw, sizeof value);
}

template <class Value>
std::string bytes_of_values(const std::vector<Value>& values, bool is_big = false) {
    std::string bytes;
    for (const Value value : values) append_value(bytes, value, is_big);
    return bytes;
}

/// A numpy array: `descr` as in '<u2', `shape` as in "3, 4, 5".
inline std::string npy_bytes(const std::string& descr, const std::string& shape,
                             const std::string& data, bool is_fortran = false, int version = 1) {
    std::string header = "{'descr': '" + descr +
                         "', 'fortran_order': " + (is_fortran ? "True" : "False") + ", 'shape': (" +
                         shape + "), }";
    const size_t before = version == 1 ? 10 : 12;
    while ((before + header.size() + 1) % 64 != 0) header += ' ';
    header += '\n';
    std::string bytes = "\x93NUMPY";
    bytes += char(version);
    bytes += '\0';
    if (version == 1)
        append_value(bytes, uint16_t(header.size()));
    else
        append_value(bytes, uint32_t(header.size()));
    return bytes + header + data;
}

inline std::string gzipped(const std::string& plain) {
    std::string packed(plain.size() + 1024, '\0');
    z_stream stream{};
    deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
    stream.avail_in = uInt(plain.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = uInt(packed.size());
    deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

/// The numbers of a NIfTI 1 header that tests choose.
struct NiftiSample {
    std::array<int16_t, 8> dim{3, 2, 3, 4, 1, 1, 1, 1};
    int16_t datatype = 4, bits = 16;
    std::array<float, 8> pixdim{1, 1, 1, 1, 0, 0, 0, 0};
    float slope = 0, intercept = 0;
    char units = 2;  ///< millimetres
    int16_t qform = 0, sform = 0;
    std::array<float, 6> quatern{};  ///< b, c, d and the offset
    std::array<float, 12> srow{};
    bool is_pair = false;  ///< `data` are in another file
};

inline std::string nifti_bytes(const NiftiSample& sample, const std::string& data,
                               bool is_big = false) {
    std::string bytes;
    const auto fill_to = [&](size_t size) { bytes.resize(size, '\0'); };
    append_value(bytes, int32_t{348}, is_big);
    fill_to(40);
    for (const int16_t n : sample.dim) append_value(bytes, n, is_big);
    fill_to(70);
    append_value(bytes, sample.datatype, is_big);
    append_value(bytes, sample.bits, is_big);
    fill_to(76);
    for (const float p : sample.pixdim) append_value(bytes, p, is_big);
    append_value(bytes, sample.is_pair ? 0.0f : 352.0f, is_big);
    append_value(bytes, sample.slope, is_big);
    append_value(bytes, sample.intercept, is_big);
    fill_to(123);
    bytes += sample.units;
    fill_to(252);
    append_value(bytes, sample.qform, is_big);
    append_value(bytes, sample.sform, is_big);
    for (const float q : sample.quatern) append_value(bytes, q, is_big);
    for (const float s : sample.srow) append_value(bytes, s, is_big);
    fill_to(344);
    bytes += sample.is_pair ? "ni1" : "n+1";
    fill_to(352);
    return bytes + data;
}

}  // namespace voxelume
