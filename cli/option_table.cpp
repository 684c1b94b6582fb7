// SPDX-License-Identifier: Apache-2.0
#include "cli/option_table.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/commands.hpp"

namespace voxelume::cli {
namespace {

OptionFacts facts_of(const CLI::Option& option) {
    OptionFacts facts;
    for (const std::string& name : option.get_snames()) facts.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) facts.names.push_back("--" + name);
    if (facts.names.empty()) facts.argument = option.get_name(true);
    if (option.get_expected_max() > 0) facts.value = option.get_type_name();
    // A type such as "auto|bar" lists the values.
    if (facts.value.find('|') != std::string::npos)
        facts.words = CLI::detail::split(facts.value, '|');
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
