// SPDX-License-Identifier: Apache-2.0
// The sentence with which a reader refuses a damaged mesh.
#pragma once

#include "runtime/base/error.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"

#include <gtest/gtest.h>

#include <string>

namespace voxelume {

/// The sentence of the error, which is expected to be an input error.
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
