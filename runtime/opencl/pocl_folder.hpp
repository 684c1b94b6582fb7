// The cache folder that PoCL gets from us: this process's own, filled from our cache and emptied
// into it.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "runtime/base/disk_cache.hpp"

namespace voxelume {

/// A kernel file of a program that was joined from several. What is compiled of its kernels serves
/// every other program that has it.
struct ProgramPart {
    std::string key;                ///< of the cache's entry
    std::set<std::string> kernels;  ///< their names
};

/// PoCL keeps what it compiled in files that it trusts blindly: processes that share a cold folder
/// fail each other's builds (9 of 96 with PoCL 3.1), and a truncated file aborts the program.
///
/// So every process has a folder of its own. Before a program is built, its files of earlier runs
/// are put there from a checksummed entry of our cache; when a device is closed, files that are new
/// (PoCL compiles a kernel at its first launch) become the entry. A user who sets POCL_CACHE_DIR
/// gets PoCL's own behaviour.
class PoclFolder {
  public:
    /// The process's folder.
    static PoclFolder& instance();

    /// Runs `first_call`, which has PoCL start up, with POCL_CACHE_DIR set: PoCL reads it once.
    void announce(const std::function<void()>& first_call) const;

    /// Runs `build`, which has PoCL build one program, with the program's files in place, and puts
    /// those kernels there that other programs had compiled of the same `parts`.
    /// True when there were files of this program, from an earlier run or an earlier build.
    bool build_with_files(const DiskCache& cache, const std::string& key,
                          std::span<const ProgramPart> parts, const std::function<void()>& build);

    /// Writes to `cache` what PoCL compiled since.
    void publish(const DiskCache& cache);

    PoclFolder(const PoclFolder&) = delete;
    PoclFolder& operator=(const PoclFolder&) = delete;

  private:
    PoclFolder();
    ~PoclFolder();

    struct ProgramFiles {
        std::filesystem::path folder;  ///< of PoCL, below `folder_`; empty when not known
        size_t published = 0;          ///< number of files in our cache's entries
        std::vector<ProgramPart> parts;
    };
    std::filesystem::path new_program_folder() const;
    void take_kernels(const DiskCache& cache, const ProgramFiles& program) const;
    void publish_kernels(const DiskCache& cache, const ProgramFiles& program) const;
    void publish_changes(const DiskCache& cache);

    std::mutex mutex_;
    std::filesystem::path folder_;  ///< empty when the user chose PoCL's folder
    int lock_ = -1;                 ///< held while the process lives: a folder without is stale
    int process_;                   ///< a forked child leaves the folder alone
    std::map<std::string, ProgramFiles> programs_;  ///< by key
};

}  // namespace voxelume
