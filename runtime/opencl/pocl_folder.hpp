// The cache folder that PoCL gets from us: this process's own, filled from our cache and emptied
// into it.
#pragma once

#include <CL/opencl.hpp>

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>

#include "runtime/disk_cache.hpp"

namespace voxelume {

/// PoCL keeps what it compiled in files that it trusts blindly: processes that share a cold folder
/// fail each other's builds (9 of 96 with PoCL 3.1), and a truncated file aborts the program.
///
/// So every process has a folder of its own. Before a program is built, its files of earlier runs
/// are put there from a checksummed entry of our cache; when a device is closed, files that are new
/// (PoCL compiles a kernel at its first launch) become the entry. A user who sets POCL_CACHE_DIR
/// gets PoCL's own behaviour.
///
/// PoCL names a program's files by a hash of its text and 1 MB of its own headers, which takes it
/// 25 ms, but by its bitcode's hash where it is given that, 2 ms. So later runs give it the bitcode
/// that it made itself. What it calls that is learnt by building it once; the result is thrown
/// away, for PoCL 3.1 crashes when it compiles kernels of bitcode that it optimized twice.
class PoclFolder {
  public:
    /// The process's folder.
    static PoclFolder& instance();

    /// Runs `first_call`, which has PoCL start up, with POCL_CACHE_DIR set: PoCL reads it once.
    void announce(const std::function<void()>& first_call) const;

    /// Has PoCL build one program, from its source without bitcode. Returns none when it refuses
    /// bitcode.
    using Build = std::function<cl::Program(const std::string* bitcode)>;

    struct Built {
        cl::Program program;
        bool was_kept = false;  ///< files of an earlier run or an earlier build were in place
    };

    /// Runs `build`, perhaps twice, with the program's files in place.
    Built build_with_files(const DiskCache& cache, const std::string& key, const Build& build);

    /// Writes to `cache` what PoCL compiled since; no kernel may be running.
    void publish(const DiskCache& cache);

    PoclFolder(const PoclFolder&) = delete;
    PoclFolder& operator=(const PoclFolder&) = delete;

  private:
    PoclFolder();
    ~PoclFolder();

    struct ProgramFiles {
        std::filesystem::path folder;  ///< of PoCL, below `folder_`; empty when not known
        std::filesystem::path kept;    ///< what later runs' PoCL will call that
        size_t published = 0;          ///< number of files in our cache's entry
    };
    std::filesystem::path new_program_folder();
    std::filesystem::path learn_folder(const std::filesystem::path& of_source, const Build& build);
    cl::Program build_kept(const std::filesystem::path& folder, const Build& build);

    std::mutex mutex_;
    std::filesystem::path folder_;  ///< empty when the user chose PoCL's folder
    int lock_ = -1;                 ///< held while the process lives: a folder without is stale
    int process_;                   ///< a forked child leaves the folder alone
    std::set<std::filesystem::path> seen_;          ///< folders of programs
    std::map<std::string, ProgramFiles> programs_;  ///< by key
};

}  // namespace voxelume
