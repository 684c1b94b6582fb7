// SPDX-License-Identifier: Apache-2.0
// What each kernel of a source consists of, so that equal kernels are compiled once.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace voxelume {

/// A compiler's options, which blanks separate.
std::vector<std::string_view> separate_options(std::string_view options);

/// A kernel and the text that it is made of.
struct KernelSlice {
    std::string kernel;  ///< its name
    std::string text;    ///< a source of this kernel alone, in the order of the whole source
};

/// The slices of all kernels in a `source` without includes.
///
/// A slice has the functions, macros, types and constants that the kernel mentions, or that those
/// mention, and everything whose name can't be told. Comments are left out, as are directives of
/// conditions around nothing. Before it stand the constants of `options` (-DNAME=VALUE) that it
/// mentions. So kernels with equal slices are equal, whatever else their programs hold: the closure
/// over names is the one that linkers make of sections (--gc-sections).
std::vector<KernelSlice> slice_kernels(std::string_view source, std::string_view options);

}  // namespace voxelume
