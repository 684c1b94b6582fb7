// SPDX-License-Identifier: Apache-2.0
// The messages of the mesh readers, and the scanners that their text formats share.
#include "runtime/io/mesh/mesh_source.hpp"

#include "runtime/base/decimal.hpp"

#include <algorithm>
#include <cstring>

namespace voxelume {

void MeshSource::fail(std::string_view sentence) const {
    throw Error(ErrorKind::input, "{}: {}", SourcePlace(name), sentence);
}

void MeshSource::fail_at_line(const char* at, std::string_view sentence) const {
    throw Error(ErrorKind::input, "{}: {}",
                SourcePlace(name, 1 + int(std::count(begin(), at, '\n')), 0, {}), sentence);
}

void MeshSource::fail_at_byte(const char* at, std::string_view sentence) const {
    throw Error(ErrorKind::input, "{}: byte {}: {}", SourcePlace(name), at - begin(), sentence);
}

void MeshSource::require_text() const {
    const void* const nul = bytes.empty() ? nullptr : std::memchr(begin(), '\0', bytes.size());
    if (nul != nullptr) {
        fail_at_byte(static_cast<const char*>(nul),
                     "a zero byte in what should be text; save the mesh as ASCII or UTF-8");
    }
}

std::string quoted_token(const char* at) {
    constexpr size_t kShown = 24;
    const std::string_view token(at, static_cast<size_t>(skip_token(at) - at));
    std::string text(token.substr(0, kShown));
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return '"' + text + (token.size() > kShown ? "...\"" : "\"");
}

float require_number(const MeshSource& source, const char*& p, char also_end) {
    if (*p == '\n' || *p == '\0') {
        source.fail_at_line(p, "the line ends where a number should stand");
    }
    const Decimal number = scan_decimal(p);
    const bool complete = ends_token(*number.end) || *number.end == also_end;
    if (number.status == DecimalStatus::not_a_number || !complete) {
        source.fail_at_line(p, fmt::format("{} is not a finite number", quoted_token(p)));
    }
    if (number.status == DecimalStatus::beyond_float) {
        source.fail_at_line(
            p, fmt::format("{} is beyond the range of float (3.4e38)", quoted_token(p)));
    }
    p = number.end;
    return number.value;
}

}  // namespace voxelume
