// SPDX-License-Identifier: Apache-2.0
#include "cli/option_table.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "cli/shared/commands.hpp"
#include "cli/shared/import_options.hpp"
#include "runtime/voxelume_verify.hpp"

namespace voxelume::cli {
namespace {

using Words = std::vector<std::string>;

/// The names in a table's rows.
template <auto table>
Words names_of() {
    Words names;
    for (const auto& row : table()) names.emplace_back(row.name);
    return names;
}

/// The names of channels in files, as `diff --channels` accepts them; channels that number others
/// have no name.
Words plane_names() {
    Words names;
    for (const ChannelRow& row : channel_table())
        for (const std::string_view plane : row.planes)
            if (!plane.ends_with('_')) names.emplace_back(plane);
    return names;
}

Words placement_names() {
    return {"world", "instance"};
}

Words device_kinds() {
    return {"auto", "cpu", "gpu"};
}

Words several_devices() {
    return {"auto", "cpu", "gpu", "all"};
}

/// The values of a type of options whose name doesn't list its values.
struct KnownValues {
    const char* type;
    Words (*words)();
    bool is_list;
};

constexpr std::array kKnownValues = {KnownValues{"CHANNELS", names_of<channel_table>, true},
                                     KnownValues{"PLANES", plane_names, true},
                                     KnownValues{"TESTS", names_of<stress_tests>, true},
                                     KnownValues{"SCENES", names_of<bench_scenes>, true},
                                     KnownValues{"PLACEMENTS", placement_names, true},
                                     KnownValues{"VIEW", view_names, false},
                                     KnownValues{"DEVICE", device_kinds, false},
                                     KnownValues{"DEVICES", several_devices, false}};

OptionFacts facts_of(const CLI::Option& option) {
    OptionFacts facts;
    for (const std::string& name : option.get_snames()) facts.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) facts.names.push_back("--" + name);
    if (facts.names.empty()) facts.argument = option.get_name(true);
    if (option.get_expected_max() > 0) facts.value = option.get_type_name();
    // A type such as "auto|bar" lists the values.
    if (facts.value.find('|') != std::string::npos)
        facts.words = CLI::detail::split(facts.value, '|');
    for (const KnownValues& known : kKnownValues) {
        if (facts.value != known.type) continue;
        facts.words = known.words();
        facts.is_list = known.is_list;
        facts.is_device = facts.value.starts_with("DEVICE");
    }
    facts.help = option.get_description();
    return facts;
}

}  // namespace

std::vector<CommandFacts> command_facts() {
    std::vector<CommandFacts> list;
    for (const Command& command : commands()) {
        CLI::App app(command.help, command.name);
        command.add(app);
        CommandFacts& facts = list.emplace_back();
        facts.name = command.name;
        facts.help = command.help;
        for (const CLI::Option* option : app.get_options())
            facts.options.push_back(facts_of(*option));
    }
    return list;
}

}  // namespace voxelume::cli
