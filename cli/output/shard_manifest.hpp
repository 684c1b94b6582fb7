// SPDX-License-Identifier: Apache-2.0
// What came of a part of a run: a file next to the part's own, which `voxelume merge` reads.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/output/shard.hpp"

namespace voxelume::cli {

/// A file that a part wrote.
struct ShardFile {
    std::string name;  ///< from the manifest's folder
    std::string hash;  ///< of its bytes
};

/// The rows of one image that a part has.
struct ShardRows {
    int first = 0, end = 0, height = 0;  ///< row, row after the last, rows of the whole image
    std::optional<ShardFile> file;       ///< OpenEXR; none where there is no row
    std::string hash;                    ///< of the whole frame
    std::vector<std::string> outputs;    ///< the image's files, from the manifest's folder
};

/// All that is told of a part.
struct ShardManifest {
    Shard shard;
    std::string scene;                 ///< hash of all frames of the run
    std::vector<int> frames;           ///< of the whole run
    std::vector<std::string> outputs;  ///< of the run, as its options have them, from the
                                       ///< manifest's folder
    ImageFileOptions options;          ///< how images are written
    struct Frame {
        int frame = 0;
        std::vector<ShardFile> files;
    };
    std::vector<Frame> own;         ///< frames of this part
    std::optional<ShardRows> rows;  ///< where the run is one image
};

/// True if a manifest can hold this text, that is, if it is UTF-8.
bool is_text(const std::string& text);

/// Writes it. Throws Error::output.
void write_manifest(const std::filesystem::path& file, const ShardManifest& manifest);

/// Reads it. Throws Error::input.
ShardManifest read_manifest(const std::filesystem::path& file);

}  // namespace voxelume::cli
