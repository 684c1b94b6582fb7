// SPDX-License-Identifier: Apache-2.0
// A libFuzzer target: any words after a command, one a line, are its options or are refused with a
// sentence. Nothing is done that the command says. An input with a "#" in front is a file of
// settings. Under the name of the format `shard`, inputs are manifests of a run's parts.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>

#include "cli/output/shard_manifest.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/settings.hpp"
#include "runtime/voxelume.hpp"
#include "tests/fuzz/fuzz_file.hpp"

namespace {

using namespace voxelume;

void check_sentence(const std::string& sentence, const std::string& beginning = "") {
    if (!sentence.empty() && sentence.starts_with(beginning)) return;
    std::fprintf(stderr, "wrong sentence: %s\n", sentence.c_str());
    std::abort();
}

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        lines.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

void check_settings(std::span<const uint8_t> bytes) {
    static const std::filesystem::path file = fuzz_file();
    write_bytes(file, bytes);
    setenv("VOXELUME_CONFIG", file.c_str(), 1);
    for (const cli::Setting& setting : cli::settings()) unsetenv(setting.variable);
    try {
        cli::load_settings();
    } catch (const Error& error) {
        check_sentence(error.what(), file.string());
    }
}

void check_manifest(std::span<const uint8_t> bytes) {
    static const std::filesystem::path file = fuzz_file();
    write_bytes(file, bytes);
    try {
        cli::read_manifest(file);
    } catch (const Error& error) {
        check_sentence(error.what(), file.string());
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (fuzzes("shard")) {
        check_manifest({data, size});
        return 0;
    }
    if (size == 0) return 0;
    if (data[0] == '#') {
        check_settings({data, size});
        return 0;
    }
    const auto commands = cli::commands();
    const cli::Command& command = commands[data[0] % commands.size()];
    std::vector<std::string> words = lines_of({reinterpret_cast<const char*>(data) + 1, size - 1});
    std::reverse(words.begin(), words.end());
    CLI::App app(command.help, command.name);
    const cli::Action action = command.add(app);
    try {
        app.parse(std::move(words));
    } catch (const CLI::CallForHelp&) {
    } catch (const CLI::ParseError& error) {
        check_sentence(error.what());
    } catch (const Error& error) {
        check_sentence(error.what());
    }
    return 0;
}
