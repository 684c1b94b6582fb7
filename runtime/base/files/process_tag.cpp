// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/process_tag.hpp"

#include <fmt/format.h>
#include <limits.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <fstream>
#include <iterator>
#include <optional>

namespace voxelume {
namespace {

std::string host_name() {
    std::array<char, HOST_NAME_MAX + 1> name{};
    if (gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return "localhost";
    return std::string(name.data()).substr(0, 64);
}

/// The start time of a process, from the 22nd field of its `stat`. The second field is a name in
/// parentheses that may contain anything, the third the process's state. Empty if the process is
/// gone, or if the system doesn't tell; "ended" if only its number is left until its parent asks
/// for its end.
std::string start_of(pid_t process) {
    std::ifstream file(fmt::format("/proc/{}/stat", process));
    const std::string text(std::istreambuf_iterator<char>(file), {});
    size_t at = text.rfind(')');
    if (at == std::string::npos) return {};
    if (text.compare(at, 3, ") Z") == 0 || text.compare(at, 3, ") X") == 0) return "ended";
    for (int field = 2; field < 22 && at != std::string::npos; ++field) at = text.find(' ', at + 1);
    if (at == std::string::npos) return {};
    return text.substr(at + 1, text.find(' ', at + 1) - at - 1);
}

/// Takes `.NUMBER` from the end of the text.
std::optional<std::string_view> take_number(std::string_view& text) {
    const size_t dot = text.rfind('.');
    if (dot == std::string_view::npos) return std::nullopt;
    const std::string_view number = text.substr(dot + 1);
    if (number.empty() || number.size() > 20 ||
        number.find_first_not_of("0123456789") != std::string_view::npos)
        return std::nullopt;
    text.remove_suffix(number.size() + 1);
    return number;
}

}  // namespace

std::string process_tag() {
    const std::string start = start_of(getpid());
    return fmt::format("{}.{}.{}", host_name(), getpid(), start.empty() ? "0" : start);
}

bool ends_with_dead_tag(std::string_view name) {
    const auto start = take_number(name), process = take_number(name);
    if (!start || !process || !name.ends_with("." + host_name())) return false;
    pid_t number = 0;
    std::from_chars(process->data(), process->data() + process->size(), number);
    if (number <= 0) return false;
    if (kill(number, 0) != 0) return errno == ESRCH;
    const std::string found = start_of(number);
    return found == "ended" || (*start != "0" && !found.empty() && found != *start);
}

}  // namespace voxelume
