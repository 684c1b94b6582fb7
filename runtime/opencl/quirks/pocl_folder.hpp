// SPDX-License-Identifier: Apache-2.0
// PoCL's cache folder: one for each process, filled from our cache and saved to it.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "runtime/base/files/disk_cache.hpp"
#include "runtime/opencl/source/compile_turn.hpp"

namespace voxelume {

/// A kernel of a program, which every other program with an equal kernel can use once it is
/// compiled.
struct ProgramPart {
    std::string key;       ///< the key of its entry in the cache
    std::string kernel;    ///< its name
    size_t published = 0;  ///< number of its files in the entry
};

/// PoCL keeps compiled kernels in files that it trusts blindly: processes that share a cold folder
/// fail each other's builds (9 of 96 with PoCL 3.1), and a truncated file aborts the program.
///
/// So every process has a folder of its own. Before a program is built, its files of earlier runs
/// are restored from a checksummed entry of our cache. When a device is closed, new files (PoCL
/// compiles a kernel at its first launch) become the entry; a process that has the turn to compile
/// shares them as soon as its first batch of tiles is done. A user who sets POCL_CACHE_DIR gets
/// PoCL's own behaviour.
class PoclFolder {
  public:
    /// The process's folder.
    static PoclFolder& instance();

    /// Sets whether the process makes such a folder, of which it informs PoCL by a variable of the
    /// environment. It makes one unless this function forbids it before `instance` is first called.
    static void allow(bool is_allowed);

    /// Makes the folder inside another process's folder, whose owner deletes it, and takes and
    /// awaits no turn. Call this before `instance`.
    static void place_in(const std::filesystem::path& parent);

    /// The folder's path; empty if the user chose PoCL's folder.
    const std::filesystem::path& path() const { return folder_; }

    /// Deletes the process's folder if it has one, for a program that ends without destructors.
    static void remove();

    /// Runs `first_call`, which makes PoCL start up, with POCL_CACHE_DIR set: PoCL reads it once.
    void announce(const std::function<void()>& first_call) const;

    /// Runs `build`, which makes PoCL build one program, and returns true if it has had kernels
    /// compiled, too, after restoring the program's files. Also restores those of its kernels,
    /// `parts()`, that other programs compiled, unless this process built the program before.
    /// `parts` runs while `build` does, on a thread of its own. Returns true if there were files of
    /// this program, from an earlier run or an earlier build.
    bool build_with_files(const DiskCache& cache, const std::string& key,
                          const std::function<std::vector<ProgramPart>()>& parts,
                          const std::function<bool()>& build);

    /// Writes to `cache` the files that PoCL made since the last call.
    void publish(const DiskCache& cache);

    /// True if other processes may wait for what this one compiles.
    bool has_turn();

    /// Writes the files for waiting processes, and ends their waiting.
    void share(const DiskCache& cache);

    PoclFolder(const PoclFolder&) = delete;
    PoclFolder& operator=(const PoclFolder&) = delete;

  private:
    PoclFolder();
    ~PoclFolder();

    struct ProgramFiles {
        std::filesystem::path folder;  ///< PoCL's folder, below `folder_`; empty if unknown
        size_t published = 0;          ///< number of files in our cache's entries
        std::vector<ProgramPart> parts;
    };
    std::set<std::filesystem::path> built_folders() const;
    void take_kernels(const DiskCache& cache, ProgramFiles& program) const;
    void publish_kernels(const DiskCache& cache, ProgramFiles& program) const;
    bool publish_changes(const DiskCache& cache);  ///< false: there were none

    std::mutex mutex_;
    std::filesystem::path folder_;  ///< empty if the user chose PoCL's folder
    int lock_ = -1;  ///< held while the process lives: a folder without a held lock is stale
    int process_;    ///< a forked child does not touch the folder
    std::map<std::string, ProgramFiles> programs_;  ///< by key
    CompileTurn turn_;  ///< held from the first program that the cache lacks until the cache has it
};

}  // namespace voxelume
