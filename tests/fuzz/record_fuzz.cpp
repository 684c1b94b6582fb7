// SPDX-License-Identifier: Apache-2.0
// A libFuzzer target: any bytes of what the program itself leaves on a disk are its own or not.
// Formats are stamps of files (stamp) and entries of the cache with compiled kernels (packed).
#include "runtime/base/files/stamp.hpp"
#include "runtime/opencl/source/packed_files.hpp"
#include "tests/fuzz/fuzz_file.hpp"
#include "tests/fuzz/refusals.hpp"

namespace {

using namespace voxelume;

/// A file that was sealed is as it was written.
void check_stamps(std::span<const uint8_t> bytes) {
    static const std::filesystem::path file = fuzz_file();
    write_bytes(file, bytes);
    is_as_written(file);
    check_stamp(file, kNoFrame);
    std::string sealed(bytes.begin(), bytes.end());
    if (!seal(sealed)) return;
    write_bytes(file, {reinterpret_cast<const uint8_t*>(sealed.data()), sealed.size()});
    if (is_as_written(file) != true) fail_fuzzing("a seal that isn't one", sealed);
}

/// Files of an entry lie in it, one after another, below the folder that they are for.
void check_entry(std::string_view bytes) {
    try {
        for (const auto& [name, content] : packed_files(bytes))
            if (name.starts_with('/') || ('/' + name + '/').find("/../") != name.npos ||
                content.data() < bytes.data() ||
                content.data() + content.size() > bytes.data() + bytes.size())
                fail_fuzzing("a file outside", name);
    } catch (const PackedFileError&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (fuzzes("stamp"))
        check_stamps({data, size});
    else
        check_entry({reinterpret_cast<const char*>(data), size});
    return 0;
}
