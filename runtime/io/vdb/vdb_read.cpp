// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/vdb/vdb_read.hpp"

#include <fcntl.h>
#include <openvdb/io/Stream.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <fstream>

#include "runtime/io/vdb/vdb_stream.hpp"

namespace voxelume::vdb {
namespace {

std::atomic<bool> readers_are_isolated = true;

constexpr const char* kEndsEarly = "it ends too early";
constexpr const char* kNoMemory = "it declares more than there is memory";

openvdb::GridPtrVecPtr read_grids(const std::filesystem::path& path) {
    // OpenVDB's own file class reads zeros past the end of a truncated file, so a checked stream is
    // used.
    std::ifstream stream(path, std::ios::binary);
    stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    return openvdb::io::Stream(stream, false).getGrids();
}

/// Reads the grids. Returns why the file can't be read; empty if it can.
std::string failure_of(const std::filesystem::path& path, openvdb::GridPtrVecPtr& grids) {
    try {
        grids = read_grids(path);
    } catch (const std::ios_base::failure&) {
        return kEndsEarly;
    } catch (const std::bad_alloc&) {
        return kNoMemory;
    } catch (const std::exception& error) {
        return *error.what() ? error.what() : "OpenVDB gives no reason";
    }
    return {};
}

/// Runs in the child process: reads and frees the grids, writes the failure, if any, to `answer`,
/// and never returns.
[[noreturn]] void try_reading(const std::filesystem::path& path, int answer) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    openvdb::GridPtrVecPtr grids;
    const std::string failure = failure_of(path, grids);
    grids.reset();
    const size_t size = std::min<size_t>(failure.size(), 400);
    _exit(write(answer, failure.data(), size) == ssize_t(size) ? 0 : 1);
}

void try_in_child(const std::filesystem::path& path, const InputFile& readable) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) readable.refuse("can't be checked: no pipe could be opened");
    const pid_t child = fork();
    if (child == 0) try_reading(path, ends[1]);
    close(ends[1]);
    std::string failure(400, '\0');
    ssize_t size = 0;
    do size = read(ends[0], failure.data(), failure.size());
    while (size < 0 && errno == EINTR);
    failure.resize(size_t(std::max<ssize_t>(size, 0)));
    close(ends[0]);
    if (child < 0) readable.refuse("can't be checked: no process could be started");
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) failure = "it is damaged";
    if (!failure.empty()) readable.refuse(fmt::format("not a readable OpenVDB file: {}", failure));
}

}  // namespace

void isolate_vdb_readers(bool is_isolated) {
    readers_are_isolated = is_isolated;
}

openvdb::GridPtrVecPtr read_vdb_grids(const std::filesystem::path& path,
                                      const InputFile& readable) {
    openvdb::initialize();
    if (readers_are_isolated && !vdb_identifier_holds(readable)) try_in_child(path, readable);
    openvdb::GridPtrVecPtr grids;
    const std::string failure = failure_of(path, grids);
    if (!failure.empty()) readable.refuse(fmt::format("not a readable OpenVDB file: {}", failure));
    return grids;
}

}  // namespace voxelume::vdb
