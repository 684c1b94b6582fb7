// The sentence with which a damaged mesh is refused.
#pragma once

#include "runtime/base/error.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"

#include <gtest/gtest.h>

#include <string>

namespace voxelume {

/// What the error says, which is expected to be one of the input.
inline std::string refusal(const std::string& bytes, const std::string& name) {
    try {
        parse_mesh(bytes, name);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
        return error.what();
    }
    return "it was accepted";
}

}  // namespace voxelume
