// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/border/guarded.hpp"

namespace voxelume::v1 {

Error::Error(ErrorKind kind, const std::string& sentence, ErrorPlace place)
    : std::runtime_error(sentence),
      kind_(kind),
      place_(std::make_shared<const ErrorPlace>(std::move(place))) {}

Error::~Error() = default;

}  // namespace voxelume::v1

namespace voxelume::api {

v1::Error error_for_callers(const Error& error) {
    const SourcePlace place = error.place();
    return {static_cast<v1::ErrorKind>(error.kind()),
            error.what(),
            {place.file, place.line, place.column, place.key}};
}

}  // namespace voxelume::api
