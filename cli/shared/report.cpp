// SPDX-License-Identifier: Apache-2.0
#include "cli/shared/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace voxelume::cli {

namespace {

/// A value on one line, in which text from files can't control the terminal.
std::string text_of(const Report& value) {
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    if (value.is_array()) {
        std::string text;
        for (const Report& element : value) {
            if (!text.empty()) text += ' ';
            text += text_of(element);
        }
        return text;
    }
    if (value.is_null()) return "-";
    if (!value.is_string()) return value.dump();
    std::string text = value.get<std::string>();
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    return text;
}

bool is_table(const Report& value) {
    return value.is_array() && !value.empty() && value.front().is_object();
}

void print_row(const std::vector<std::string>& cells, const std::vector<size_t>& widths) {
    std::string line = " ";
    for (size_t i = 0; i < cells.size(); ++i)
        line += i == 0 ? fmt::format(" {:<{}}", cells[i], widths[i])
                       : fmt::format("  {:>{}}", cells[i], widths[i]);
    fmt::print("{}\n", line);
}

void print_table(const Report& rows) {
    std::vector<std::vector<std::string>> lines(1);
    for (const auto& column : rows.front().items()) lines[0].push_back(column.key());
    for (const Report& row : rows) {
        lines.emplace_back();
        for (const auto& cell : row.items()) lines.back().push_back(text_of(cell.value()));
    }
    std::vector<size_t> widths(lines[0].size(), 0);
    for (const std::vector<std::string>& line : lines)
        for (size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
    for (const std::vector<std::string>& line : lines) print_row(line, widths);
}

/// True for lists whose items take a line each.
bool is_sentences(std::string_view key) {
    return key == "notes" || key == "not shown";
}

/// Prints one sentence per line.
void print_notes(std::string_view name, const Report& notes) {
    for (const Report& note : notes) {
        fmt::print("  {:<15} {}\n", name, text_of(note));
        name = {};
    }
}

void print_object(const Report& object) {
    for (const auto& item : object.items()) {
        if (is_table(item.value()))
            print_table(item.value());
        else if (is_sentences(item.key()) && item.value().is_array())
            print_notes(item.key(), item.value());
        else if (item.value().is_object())
            print_object(item.value());
        else
            fmt::print("  {:<15} {}\n", text_of(item.key()), text_of(item.value()));
    }
}

}  // namespace

void print_report(const Report& report, bool as_json) {
    if (as_json)  // text from files may not be UTF-8
        fmt::print("{}\n", report.dump(2, ' ', false, Report::error_handler_t::replace));
    else
        print_object(report);
}

}  // namespace voxelume::cli
