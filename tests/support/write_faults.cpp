// SPDX-License-Identifier: Apache-2.0
// A library that is preloaded into the program. It counts calls that write to files below a folder,
// and makes one of them fail, as on a full or broken disk.
//
// VXL_WRITE_FAULT=FOLDER:N:ERRNO makes the N-th such call of a process (from 1 on), and all later
// ones, do nothing and fail with that error; with 0 for N, none fails. VXL_WRITE_COUNTS=FILE writes
// the number of calls to FILE when a process that made calls ends.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

struct Fault {
    std::string folder;
    long number = 0;
    int code = 0;
};

/// The fault that VXL_WRITE_FAULT asks for. An unknown form ends the program.
Fault requested_fault() {
    const char* const text = std::getenv("VXL_WRITE_FAULT");
    if (!text) return {};
    char folder[512];
    Fault fault;
    if (std::sscanf(text, "%511[^:]:%ld:%d", folder, &fault.number, &fault.code) != 3) std::abort();
    fault.folder = std::string(folder) + "/";
    return fault;
}

class Calls {
  public:
    ~Calls() {
        const char* const file = std::getenv("VXL_WRITE_COUNTS");
        if (count_ == 0 || !file) return;
        if (FILE* const out = std::fopen(file, "w")) {
            std::fprintf(out, "%ld\n", count_.load());
            std::fclose(out);
        }
    }

    /// True if the call that writes to the file or folder at `path` should fail; errno then says
    /// why.
    bool fails(const char* path) {
        if (fault_.folder.empty() || !is_below_folder(path)) return false;
        const long number = ++count_;
        if (fault_.number == 0 || number < fault_.number) return false;
        errno = fault_.code;
        return true;
    }

    bool fails(int file) {
        if (fault_.folder.empty() || file < 3) return false;
        char link[64], path[1024];
        std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
        const ssize_t size = readlink(link, path, sizeof path - 1);
        if (size <= 0) return false;
        path[size] = 0;
        return fails(path);
    }

  private:
    bool is_below_folder(const char* path) const {
        std::string whole = path;
        if (char here[1024]; *path != '/' && getcwd(here, sizeof here))
            whole = here + ("/" + whole);
        return (whole + "/").starts_with(fault_.folder);
    }

    const Fault fault_ = requested_fault();
    std::atomic<long> count_ = 0;
};

Calls calls;

template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

#define VXL_WRITING_CALL(type, name, parameters, arguments, where)       \
    extern "C" type name parameters {                                    \
        static decltype(&name) const real = next<decltype(name)>(#name); \
        if (calls.fails(where)) return -1;                               \
        return real arguments;                                           \
    }

VXL_WRITING_CALL(ssize_t, write, (int file, const void* data, size_t size), (file, data, size),
                 file)
VXL_WRITING_CALL(ssize_t, pwrite, (int file, const void* data, size_t size, off_t at),
                 (file, data, size, at), file)
VXL_WRITING_CALL(ssize_t, pwrite64, (int file, const void* data, size_t size, off64_t at),
                 (file, data, size, at), file)
VXL_WRITING_CALL(ssize_t, writev, (int file, const iovec* parts, int count), (file, parts, count),
                 file)
VXL_WRITING_CALL(int, ftruncate, (int file, off_t size) noexcept, (file, size), file)
VXL_WRITING_CALL(int, fsync, (int file), (file), file)
VXL_WRITING_CALL(int, fdatasync, (int file), (file), file)
VXL_WRITING_CALL(int, rename, (const char* from, const char* to) noexcept, (from, to), to)
