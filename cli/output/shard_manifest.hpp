// SPDX-License-Identifier: Apache-2.0
// The results of one part of a run: a file next to the part's own files, which `voxelume merge`
// reads.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/output/shard.hpp"

namespace voxelume::cli {

/// A file that a part wrote.
struct ShardFile {
    std::string name;  ///< relative to the manifest's folder
    std::string hash;  ///< of its bytes
};

/// The rows of one image that a part renders.
struct ShardRows {
    int first = 0, end = 0, height = 0;  ///< row, row after the last, rows of the whole image
    std::optional<ShardFile> file;       ///< OpenEXR; none if the part has no rows
    std::string hash;                    ///< of the whole frame
    std::vector<std::string> outputs;    ///< the image's files, relative to the manifest's folder
};

/// All that a manifest says about a part.
struct ShardManifest {
    Shard shard;
    std::string scene;                 ///< hash of all frames of the run
    std::vector<int> frames;           ///< of the whole run
    std::vector<std::string> outputs;  ///< of the run, as in its options, relative to the
                                       ///< manifest's folder
    ImageFileOptions options;          ///< for writing images
    struct Frame {
        int frame = 0;
        std::vector<ShardFile> files;
    };
    std::vector<Frame> own;         ///< frames of this part
    std::optional<ShardRows> rows;  ///< if the run is one image
};

/// True if a manifest can hold this text, which must be UTF-8.
bool is_text(const std::string& text);

/// Writes a manifest. Throws Error::output.
void write_manifest(const std::filesystem::path& file, const ShardManifest& manifest);

/// Reads a manifest. Throws Error::input.
ShardManifest read_manifest(const std::filesystem::path& file);

}  // namespace voxelume::cli
