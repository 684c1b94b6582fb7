// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/source/kernel_source.hpp"

#include <array>
#include <mutex>
#include <unordered_set>
#include <utility>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

std::string_view file_text(const std::string& file) {
    const auto& files = embedded_kernels();
    const auto found = files.find(file);
    if (found == files.end())
        throw Error(ErrorKind::build, "kernels/{}: no such kernel file in this program", file);
    return found->second;
}

/// The path in `#include "path"`, or an empty string if the line is something else.
std::string included_path(std::string_view line) {
    constexpr std::string_view kDirective = "#include \"";
    if (!line.starts_with(kDirective)) return {};
    line.remove_prefix(kDirective.size());
    return std::string(line.substr(0, line.find('"')));
}

void append_text(const std::string& label, std::string_view rest, std::set<std::string>& seen,
                 std::string& source) {
    source += fmt::format("#line 1 \"{}\"\n", label);
    for (int number = 1; !rest.empty(); ++number) {
        const size_t end = rest.find('\n');
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        const std::string path = included_path(line);
        if (path.empty()) {
            source.append(line).append("\n");
        } else if (seen.insert(path).second) {
            append_text("kernels/" + path, file_text(path), seen, source);
            source += fmt::format("#line {} \"{}\"\n", number + 1, label);
        } else {
            source += '\n';
        }
    }
}

bool is_of_word(char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

}  // namespace

KernelSource::KernelSource(std::string text) : text_(std::move(text)) {
    std::unordered_set<std::string_view> found;
    for (const char* end = text_.data(); *end != 0;) {
        const char* word = end;
        while (*end != 0 && is_of_word(*end)) ++end;
        if (*word >= 'A' && *word <= 'Z') found.emplace(word, size_t(end - word));
        while (*end != 0 && !is_of_word(*end)) ++end;
    }
    constants_.insert(found.begin(), found.end());
}

bool KernelSource::mentions(const std::string& constant) const {
    return constants_.contains(constant);
}

const KernelSource& kernel_source(const std::string& file) {
    static std::mutex mutex;
    static std::map<std::string, KernelSource> sources;
    const std::lock_guard lock(mutex);
    const auto found = sources.find(file);
    if (found != sources.end()) return found->second;
    const std::array files = {file.c_str()};
    return sources.emplace(file, kernel_source(files)).first->second;
}

KernelSource kernel_source(std::span<const char* const> files) {
    std::string source;
    std::set<std::string> seen;
    for (const std::string file : files)
        if (seen.insert(file).second) append_text("kernels/" + file, file_text(file), seen, source);
    return KernelSource(std::move(source));
}

KernelSource expand_includes(std::string_view text) {
    std::string source;
    std::set<std::string> seen;
    append_text("text", text, seen, source);
    return KernelSource(std::move(source));
}

}  // namespace voxelume
