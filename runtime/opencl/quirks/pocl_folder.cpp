// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/quirks/pocl_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <future>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "runtime/opencl/quirks/pocl_folder_names.hpp"
#include "runtime/opencl/source/packed_files.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

/// The process's folder once it is made, for code that must not make it.
std::atomic<const PoclFolder*> existing_folder = nullptr;

std::atomic<bool> folder_is_allowed = true;

/// Held while a file is restored. None is any more once the folder is removed.
std::mutex unpacking;
bool is_removed = false;

/// The folder of the process that this helper works for; empty in other processes.
fs::path& helped_folder() {
    static fs::path folder;
    return folder;
}

/// The files of a program that later runs need, by path from `root`: bitcode, kernels, messages.
std::vector<fs::path> files_worth_keeping(const fs::path& root, const fs::path& folder) {
    std::set<fs::path> files;  // sorted, so that equal contents make equal entries
    std::error_code error;
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(root / folder, error)) {
        const fs::path& path = entry.path();
        if (path.filename() == "program.bc" || path.filename() == "build.log" ||
            path.extension() == ".so")
            files.insert(path.lexically_relative(root));
    }
    return {files.begin(), files.end()};
}

/// The files of a compiled kernel, by their paths from the program's folder.
std::vector<fs::path> kernels_of(const fs::path& program, const ProgramPart& part) {
    return files_worth_keeping(program, part.kernel);
}

/// Writes a file that appears only when it is whole, since PoCL may look for it meanwhile.
void write_whole(const fs::path& path, std::string_view text) {
    const fs::path unfinished = path.string() + ".part";
    std::ofstream file(unfinished, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    if (!file) {
        fs::remove(unfinished);
        throw fs::filesystem_error("not written", path, std::make_error_code(std::errc::io_error));
    }
    fs::permissions(unfinished, fs::perms::owner_all);
    fs::rename(unfinished, path);
}

/// Writes the files that an entry packs below `root`, except those that exist, since kernels run
/// from them. Returns the paths of all files relative to `root`. Throws PackedFileError, before
/// anything is written, for an entry that isn't one of ours.
std::vector<fs::path> unpack(const fs::path& root, std::string_view bytes) {
    std::vector<fs::path> paths;
    for (const auto& [name, content] : packed_files(bytes)) {
        paths.emplace_back(name);
        const fs::path path = root / name;
        const std::lock_guard lock(unpacking);
        if (is_removed) throw std::runtime_error("the process ends");
        fs::create_directories(path.parent_path());
        if (!fs::exists(path)) write_whole(path, content);
    }
    return paths;
}

/// The folder of the program that files belong to, which PoCL names by two letters and the rest of
/// a hash; empty if there are no such files.
fs::path program_of(const std::vector<fs::path>& files) {
    if (files.empty() || std::distance(files[0].begin(), files[0].end()) < 3) return {};
    const auto letters = files[0].begin();
    return *letters / *std::next(letters);
}

/// The only folder that is in `after` but not in `before`; empty if there is none or more than one.
fs::path only_new(const std::set<fs::path>& before, const std::set<fs::path>& after) {
    std::vector<fs::path> found;
    std::ranges::set_difference(after, before, std::back_inserter(found));
    return found.size() == 1 ? found[0] : fs::path();
}

}  // namespace

void PoclFolder::allow(bool is_allowed) {
    folder_is_allowed = is_allowed;
}

void PoclFolder::place_in(const fs::path& parent) {
    helped_folder() = parent;
}

PoclFolder& PoclFolder::instance() {
    static PoclFolder folder;
    return folder;
}

void PoclFolder::remove() {
    const PoclFolder* const folder = existing_folder;
    if (folder == nullptr || folder->folder_.empty()) return;
    {
        const std::lock_guard lock(unpacking);
        is_removed = true;
    }
    // PoCL may be compiling in another thread, and makes its folders again unless a file is in the
    // way.
    const fs::path moved = folder->folder_.string() + "-ended";
    constexpr int kAttempts = 20;
    std::error_code error;
    int descriptor = -1;
    for (int i = 0; i < kAttempts && descriptor < 0; ++i) {
        fs::rename(folder->folder_, moved, error);
        descriptor = open(folder->folder_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
        fs::remove_all(moved, error);
    }
    if (descriptor < 0) return;  // the next run removes the rest
    close(descriptor);
    unlink(folder->folder_.c_str());
}

PoclFolder::PoclFolder()
    : process_(getpid()), turn_(std::chrono::minutes(helped_folder().empty() ? 1 : 0)) {
    if (!folder_is_allowed || std::getenv("POCL_CACHE_DIR")) return;
    if (!helped_folder().empty()) {
        folder_ = make_pocl_folder(helped_folder());
        return;
    }
    // Some systems forbid programs, such as kernels, in the temporary folder, so it is tried last.
    std::error_code error;
    for (const fs::path& parent : {cache_folder(), fs::temp_directory_path(error)}) {
        if (parent.empty()) continue;
        remove_stale_pocl_folders(parent);
        folder_ = make_pocl_folder(parent);
        if (!folder_.empty()) break;
    }
    if (folder_.empty()) return;
    existing_folder = this;
    lock_ = open((folder_ / kPoclFolderLock).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (lock_ >= 0) flock(lock_, LOCK_EX | LOCK_NB);
}

void PoclFolder::announce(const std::function<void()>& first_call) const {
    if (folder_.empty()) return first_call();
    setenv("POCL_CACHE_DIR", folder_.c_str(), 1);
    first_call();
    unsetenv("POCL_CACHE_DIR");  // a child process must not mistake it for its user's choice
}

PoclFolder::~PoclFolder() {
    if (folder_.empty() || getpid() != process_) return;
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    if (lock_ >= 0) close(lock_);
}

/// The folders of the programs that PoCL has built. It names each by a hash of its own, two letters
/// and the rest, and leaves `last_accessed` in it, but no bitcode where a build failed.
std::set<fs::path> PoclFolder::built_folders() const {
    std::set<fs::path> built;
    std::error_code error;
    for (const fs::directory_entry& letters : fs::directory_iterator(folder_, error))
        for (const fs::directory_entry& rest : fs::directory_iterator(letters.path(), error))
            if (fs::exists(rest.path() / "last_accessed", error) &&
                fs::exists(rest.path() / "program.bc", error))
                built.insert(rest.path().lexically_relative(folder_));
    return built;
}

/// Restores the kernels of the program's parts that were compiled for other programs, except those
/// that it has restored.
void PoclFolder::take_kernels(const DiskCache& cache, ProgramFiles& program) const {
    try {
        for (ProgramPart& part : program.parts) {
            if (part.published > 0) continue;
            if (const auto bytes = cache.read(part.key))
                part.published = unpack(folder_ / program.folder, *bytes).size();
        }
    } catch (const std::exception&) {
        return;  // the disk is full by now: PoCL compiles the missing files
    }
}

bool PoclFolder::build_with_files(const DiskCache& cache, const std::string& key,
                                  const std::function<std::vector<ProgramPart>()>& parts,
                                  const std::function<bool()>& build) {
    const std::lock_guard guard(mutex_);  // one build at a time, to know whose folder is new
    if (folder_.empty() || programs_.contains(key)) {
        build();
        return !folder_.empty();
    }
    std::vector<fs::path> unpacked;
    try {
        if (const auto bytes = turn_.read(cache, key)) unpacked = unpack(folder_, *bytes);
    } catch (const std::exception&) {
        unpacked.clear();  // the disk is full by now: PoCL compiles the missing files
    }
    // Finding the parts and reading kernels takes tens of milliseconds, and so does building.
    auto restoring = std::async(std::launch::async | std::launch::deferred, [&] {
        ProgramFiles program = {program_of(unpacked), 0, parts()};
        if (!program.folder.empty()) take_kernels(cache, program);
        return program;
    });
    const std::set<fs::path> before = built_folders();
    const bool has_new_kernels = build();
    const fs::path folder = only_new(before, built_folders());
    ProgramFiles program = restoring.get();
    // An entry for a folder other than PoCL's is useless and gets replaced.
    if (folder != program.folder) unpacked.clear();
    if (folder.empty()) {
        program = {};
    } else {
        // What this process compiled for other programs may be new in entries that are restored.
        if (publish_changes(cache) || folder != program.folder)
            for (ProgramPart& part : program.parts) part.published = 0;
        program.folder = folder;
        take_kernels(cache, program);
        if (!unpacked.empty() && !has_new_kernels)
            program.published = files_worth_keeping(folder_, folder).size();
    }
    programs_[key] = std::move(program);
    return !unpacked.empty();
}

void PoclFolder::publish_kernels(const DiskCache& cache, ProgramFiles& program) const {
    const fs::path own = folder_ / program.folder;
    for (ProgramPart& part : program.parts) {
        if (kernels_of(own, part).size() <= part.published) continue;
        const auto bytes = cache.read(part.key);  // other processes may have extended it since then
        size_t known = 0;
        try {
            if (bytes) known = unpack(own, *bytes).size();
        } catch (const PackedFileError&) {
            known = 0;  // the entry gets replaced
        }
        const std::vector<fs::path> files = kernels_of(own, part);
        if (files.size() > known) cache.write(part.key, packed(own, files));
        part.published = files.size();
    }
}

bool PoclFolder::publish_changes(const DiskCache& cache) {
    bool is_changed = false;
    for (auto& [key, program] : programs_) {
        if (program.folder.empty()) continue;
        std::vector<fs::path> files = files_worth_keeping(folder_, program.folder);
        if (files.size() <= program.published) continue;
        program.published = files.size();
        is_changed = true;
        try {
            publish_kernels(cache, program);
        } catch (const std::exception&) {
            continue;  // the disk is full
        }
        std::erase_if(files, [](const fs::path& file) { return file.extension() == ".so"; });
        cache.write(key, packed(folder_, files));
    }
    return is_changed;
}

void PoclFolder::publish(const DiskCache& cache) {
    const std::lock_guard guard(mutex_);
    publish_changes(cache);
    turn_.release();
}

bool PoclFolder::has_turn() {
    const std::lock_guard guard(mutex_);
    return turn_.is_taken();
}

void PoclFolder::share(const DiskCache& cache) {
    const std::lock_guard guard(mutex_);
    if (!turn_.is_taken()) return;
    publish_changes(cache);
    turn_.release();
}

}  // namespace voxelume
