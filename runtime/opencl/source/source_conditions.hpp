// SPDX-License-Identifier: Apache-2.0
// Conditions of a kernel source that its constants decide: what a preprocessor would leave out.
#pragma once

#include <string>
#include <string_view>

#include "runtime/opencl/source/source_macros.hpp"

namespace voxelume {

/// A source without comments, with only those branches of its #if, #ifdef and #ifndef that hold.
///
/// Names that begin with VXL_ are ours: where neither a constant nor the source defines one, it is
/// undefined. A condition that depends on anything else, such as a compiler's own macros, stays
/// with everything in it. `#line` and what is for C++ are left out, and lines that end in a
/// backslash are joined to the next.
struct ResolvedSource {
    std::string text;
    bool has_order = false;  ///< the text's order counts, since it defines a macro in several ways
};
ResolvedSource resolve_conditions(std::string_view source, const SourceConstants& constants);

}  // namespace voxelume
