// SPDX-License-Identifier: Apache-2.0
// A library that is preloaded into the program. It counts calls that write to files below a folder,
// and makes one of them fail, as on a full or broken disk.
//
// VXL_WRITE_FAULT=FOLDER:N:ERRNO makes the N-th such call of a process (from 1 on), and all later
// ones, do nothing and fail with that error; with 0 for N, none fails. FOLDER:N:ERRNO:once has that
// call alone fail. FOLDER:N:wrong has that call alone succeed and write another last byte, if it
// writes bytes. VXL_WRITE_COUNTS=FILE writes the number of calls to FILE when a process that made
// calls ends. VXL_UNLINK_DELAY=MICROSECONDS makes each file of a folder take that long to remove.
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
    bool is_once = false;
    bool is_wrong = false;  ///< the call writes a wrong byte
};

/// The fault that VXL_WRITE_FAULT asks for. An unknown form ends the program.
Fault requested_fault() {
    const char* const text = std::getenv("VXL_WRITE_FAULT");
    if (!text) return {};
    char folder[512], error[16], times[8] = "";
    Fault fault;
    if (std::sscanf(text, "%511[^:]:%ld:%15[^:]:%7s", folder, &fault.number, error, times) < 3)
        std::abort();
    fault.folder = std::string(folder) + "/";
    fault.is_wrong = std::strcmp(error, "wrong") == 0;
    fault.is_once = std::strcmp(times, "once") == 0;
    fault.code = std::atoi(error);
    if ((!fault.is_wrong && fault.code == 0 && fault.number != 0) || (*times && !fault.is_once))
        std::abort();
    return fault;
}

enum class Result { right, failure, wrong };

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

    /// Counts the call that writes to the file or folder at `path`. Says whether it should do as it
    /// is told, fail, for which errno is set, or write a wrong byte.
    Result result_at(const char* path) {
        if (fault_.folder.empty() || !is_below_folder(path)) return Result::right;
        const long number = ++count_;
        const bool is_one_alone = fault_.is_once || fault_.is_wrong;
        if (fault_.number == 0 || number < fault_.number) return Result::right;
        if (is_one_alone && number > fault_.number) return Result::right;
        if (fault_.is_wrong) return Result::wrong;
        errno = fault_.code;
        return Result::failure;
    }

    Result result_at(int file) {
        if (fault_.folder.empty() || file < 3) return Result::right;
        char link[64], path[1024];
        std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
        const ssize_t size = readlink(link, path, sizeof path - 1);
        if (size <= 0) return Result::right;
        path[size] = 0;
        return result_at(path);
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

/// Bytes with another last one.
std::string wrong_bytes(const void* data, size_t size) {
    std::string bytes(static_cast<const char*>(data), size);
    if (!bytes.empty()) bytes.back() = static_cast<char>(bytes.back() ^ 1);
    return bytes;
}

}  // namespace

#define VXL_WRITING_CALL(type, name, parameters, arguments, where)       \
    extern "C" type name parameters {                                    \
        static decltype(&name) const real = next<decltype(name)>(#name); \
        if (calls.result_at(where) == Result::failure) return -1;        \
        return real arguments;                                           \
    }

/// A call that writes `size` bytes of `data`.
#define VXL_BYTES_CALL(name, parameters, arguments)                      \
    extern "C" ssize_t name parameters {                                 \
        static decltype(&name) const real = next<decltype(name)>(#name); \
        const Result result = calls.result_at(file);                     \
        if (result == Result::failure) return -1;                        \
        if (result == Result::right) return real arguments;              \
        const std::string bytes = wrong_bytes(data, size);               \
        data = bytes.data();                                             \
        return real arguments;                                           \
    }

VXL_BYTES_CALL(write, (int file, const void* data, size_t size), (file, data, size))
VXL_BYTES_CALL(pwrite, (int file, const void* data, size_t size, off_t at), (file, data, size, at))
VXL_BYTES_CALL(pwrite64, (int file, const void* data, size_t size, off64_t at),
               (file, data, size, at))
VXL_WRITING_CALL(ssize_t, writev, (int file, const iovec* parts, int count), (file, parts, count),
                 file)
VXL_WRITING_CALL(int, ftruncate, (int file, off_t size) noexcept, (file, size), file)
VXL_WRITING_CALL(int, fsync, (int file), (file), file)
VXL_WRITING_CALL(int, fdatasync, (int file), (file), file)
VXL_WRITING_CALL(int, rename, (const char* from, const char* to) noexcept, (from, to), to)

extern "C" int unlinkat(int folder, const char* path, int flags) noexcept {
    static decltype(&unlinkat) const real = next<decltype(unlinkat)>("unlinkat");
    if (const char* const delay = std::getenv("VXL_UNLINK_DELAY"))
        usleep(static_cast<useconds_t>(std::atoi(delay)));
    return real(folder, path, flags);
}
