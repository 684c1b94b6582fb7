// SPDX-License-Identifier: Apache-2.0
// The code that each kernel of a source needs, so that equal kernels are compiled once.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace voxelume {

/// A compiler's options, which blanks separate.
std::vector<std::string_view> separate_options(std::string_view options);

/// A kernel and the text of the code that it needs.
struct KernelSlice {
    std::string kernel;  ///< its name
    std::string text;    ///< a source of this kernel alone, in an order of its own
};

/// The slices of all kernels in a `source` without includes. Where the order of its text counts,
/// each has all of it.
///
/// A slice has the functions, macros, types and constants that the kernel mentions, directly or
/// indirectly, and everything whose name is unknown, each behind what it mentions. Comments are
/// left out, as are conditions that can be decided. The constants of `options` (-DNAME=VALUE) that
/// it mentions come first. So
/// kernels with equal slices are equal, whatever else their programs hold: the closure over names
/// is like that of linkers over sections (--gc-sections).
std::vector<KernelSlice> slice_kernels(std::string_view source, std::string_view options);

}  // namespace voxelume
