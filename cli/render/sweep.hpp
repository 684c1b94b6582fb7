// SPDX-License-Identifier: Apache-2.0
// `--sweep PATH=V1,V2`: the combinations of values for which a scene is rendered.
#pragma once

#include <string>
#include <vector>

namespace voxelume::cli {

/// A value of the scene, and the values that replace it, one after another.
struct Sweep {
    std::string path;  ///< "lights.key.intensity"
    std::vector<std::string> values;
};

/// Reads "PATH=V1,V2". Lists, objects and quoted texts may contain commas. Throws Error::usage.
Sweep parse_sweep(const std::string& text, const char* command);

/// The combinations of one value for each sweep, in order; the last sweep's value changes fastest.
/// Without sweeps, there is one empty combination. Throws Error::usage for more than a million.
std::vector<std::vector<std::string>> combinations(const std::vector<Sweep>& sweeps,
                                                   const char* command);

/// The last key of a path: "intensity".
std::string last_key(const std::string& path);

/// A value in the form for a file name: "[0, 1, 0]" becomes "0,1,0".
std::string file_part(const std::string& value);

}  // namespace voxelume::cli
