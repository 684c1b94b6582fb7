// SPDX-License-Identifier: Apache-2.0
// The format that a fuzz target is for, as the name says by which it was started.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace voxelume {

/// The name of its input: "fuzz.ply" of mesh_fuzz_ply.
inline const std::string& fuzz_name() {
    static const std::string name = [] {
        const std::string program = program_invocation_short_name;
        const size_t at = program.find("_fuzz_");
        if (at == program.npos) {
            std::fputs("Start it by a name with a format, e.g. mesh_fuzz_ply.\n", stderr);
            std::exit(2);
        }
        return "fuzz." + program.substr(at + 6);
    }();
    return name;
}

/// Whether its inputs have this format.
inline bool fuzzes(const std::string& format) {
    return fuzz_name() == "fuzz." + format;
}

}  // namespace voxelume
