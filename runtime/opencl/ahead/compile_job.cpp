// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/ahead/compile_job.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace voxelume {
namespace {

constexpr uint64_t kMaxBytes = 64u << 20;

void append(std::string& bytes, uint64_t number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void append(std::string& bytes, std::string_view text) {
    append(bytes, uint64_t{text.size()});
    bytes.append(text);
}

uint64_t take_number(std::string_view& bytes) {
    uint64_t number = 0;
    if (bytes.size() < sizeof number) throw std::runtime_error("a job ends early");
    std::memcpy(&number, bytes.data(), sizeof number);
    bytes.remove_prefix(sizeof number);
    return number;
}

std::string take_text(std::string_view& bytes) {
    const uint64_t size = take_number(bytes);
    if (size > bytes.size()) throw std::runtime_error("a job's text ends early");
    std::string text(bytes.substr(0, size));
    bytes.remove_prefix(size);
    return text;
}

/// Returns false where the descriptor ends before `size` bytes.
bool read_all(int descriptor, char* data, size_t size) {
    while (size > 0) {
        const ssize_t got = read(descriptor, data, size);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        data += got;
        size -= size_t(got);
    }
    return true;
}

/// A text with its count.
std::string message_of(std::string_view content) {
    std::string bytes;
    append(bytes, content);
    return bytes;
}

/// The next text with its count; empty at the descriptor's end.
std::optional<std::string> next_message(int descriptor) {
    uint64_t size = 0;
    if (!read_all(descriptor, reinterpret_cast<char*>(&size), sizeof size)) return std::nullopt;
    if (size > kMaxBytes) throw std::runtime_error("a job is too large");
    std::string content(size, '\0');
    if (!read_all(descriptor, content.data(), size)) return std::nullopt;
    return content;
}

}  // namespace

std::string bytes_of(const CompileJob& job) {
    std::string content;
    append(content, std::string_view(job.label));
    append(content, std::string_view(job.source));
    append(content, std::string_view(job.options));
    return message_of(content);
}

std::string bytes_of(const std::optional<CompiledKernel>& kernel) {
    std::string content;
    if (kernel) {
        append(content, std::string_view(kernel->name));
        append(content, kernel->group);
    }
    return message_of(content);
}

std::optional<CompileJob> next_job(int descriptor) {
    const std::optional<std::string> content = next_message(descriptor);
    if (!content) return std::nullopt;
    std::string_view rest = *content;
    CompileJob job;
    job.label = take_text(rest);
    job.source = take_text(rest);
    job.options = take_text(rest);
    return job;
}

std::optional<CompiledKernel> next_kernel(int descriptor) {
    const std::optional<std::string> content = next_message(descriptor);
    if (!content || content->empty()) return std::nullopt;
    std::string_view rest = *content;
    std::string name = take_text(rest);
    return CompiledKernel{std::move(name), take_number(rest)};
}

}  // namespace voxelume
