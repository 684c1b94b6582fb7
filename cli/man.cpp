// SPDX-License-Identifier: Apache-2.0
// voxelume man: the manual page, in troff.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/option_table.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/settings.hpp"
#include "runtime/voxelume.hpp"

namespace voxelume::cli {
namespace {

/// The text, escaped so that troff prints it as it is.
std::string plain(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
    }
    // A line that begins with a dot or a quote would be a request to troff.
    if (result.starts_with('.') || result.starts_with('\'')) result.insert(0, "\\&");
    return result;
}

/// Allows a line break after each bar of a list of words such as "auto|bar".
std::string breakable(const std::string& text) {
    std::string result;
    for (const char c : text) {
        result += c;
        if (c == '|') result += "\\:";
    }
    return result;
}

/// Prints lines of text, each on its own line of the page.
void print_lines(const std::string& text) {
    size_t start = 0;
    while (start < text.size()) {
        const size_t end = std::min(text.find('\n', start), text.size());
        fmt::print("{}{}\n", start > 0 ? ".br\n" : "", plain(text.substr(start, end - start)));
        start = end + 1;
    }
}

void print_option(const OptionFacts& option) {
    std::string title;
    for (const std::string& name : option.names)
        title += (title.empty() ? "" : ", ") + ("\\fB" + plain(name) + "\\fR");
    if (option.names.empty()) title = "\\fI" + plain(option.argument) + "\\fR";
    if (!option.names.empty() && !option.value.empty())
        title += " \\fI" + breakable(plain(option.value)) + "\\fR";
    fmt::print(".TP\n{}\n", title);
    print_lines(option.help);
}

void print_command(const CommandFacts& command) {
    fmt::print(".SS \"voxelume {}\"\n", plain(command.name));
    print_lines(command.help + ".");
    for (const OptionFacts& option : command.options) print_option(option);
}

int print_page() {
    fmt::print(".TH VOXELUME 1 \"\" \"voxelume {}\" \"User Commands\"\n", version());
    fmt::print(".SH NAME\nvoxelume \\- images of voxel worlds, flat and volumetric\n");
    fmt::print(".SH SYNOPSIS\n.B voxelume\n.I COMMAND\n.RI [ OPTIONS ]\n");
    fmt::print(".SH COMMANDS\nOptions stand in any order.\n");
    for (const CommandFacts& command : command_facts()) print_command(command);
    fmt::print(".SH EXIT STATUS\n.nf\n");
    print_lines(exit_codes_text());
    fmt::print(".fi\n.SH ENVIRONMENT\n");
    for (const Setting& setting : settings())
        fmt::print(".TP\n\\fB{}\\fR\n{}\n", plain(setting.variable), plain(setting.help));
    fmt::print(".TP\n\\fBVOXELUME_CONFIG\\fR\nfile of settings\n");
    for (const SharedVariable& shared : shared_variables())
        fmt::print(".TP\n\\fB{}\\fR\n{}\n", plain(shared.variable), plain(shared.help));
    fmt::print(
        ".SH FILES\n.TP\n~/.config/voxelume/config\n"
        "settings, a line each: a name that \\fBvoxelume config\\fR prints, =, and its value; the "
        "environment counts more\n");
    return 0;
}

}  // namespace

Action add_man(CLI::App&) {
    return [] { return print_page(); };
}

}  // namespace voxelume::cli
