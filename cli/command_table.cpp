// SPDX-License-Identifier: Apache-2.0
// The table of commands, and the exit codes.
#include <array>

#include "cli/shared/commands.hpp"

namespace voxelume::cli {
namespace {

/// All commands, in the order in which a user meets them.
constexpr std::array kCommands = {
    Command{"devices", "list the devices that can render, and say why others can't", add_devices},
    Command{"render", "render a scene or a model file: images, volumetric images, animations",
            add_render},
    Command{"check", "check a scene, and say what rendering it needs", add_check},
    Command{"merge", "put the parts of a run together that `render --shard` made", add_merge},
    Command{"import", "write the scene that shows a model file, to be changed", add_import},
    Command{"voxelize", "write the voxels of a mesh, a scene or a file of voxels", add_voxelize},
    Command{"info", "describe a file: image, volume, model, mesh or scene", add_info},
    Command{"convert", "convert a volumetric image, or voxels, to another format", add_convert},
    Command{"view", "show a volumetric image, model or scene as a picture, or as a page to turn",
            add_view},
    Command{"diff", "measure how far two images are apart", add_diff},
    Command{"stress", "compare what a device computes with exact arithmetic", add_stress},
    Command{"bench", "measure run time against error", add_bench},
    Command{"warm", "fill the cache with what rendering scenes takes", add_warm},
    Command{"doctor", "print what a report of a fault needs: system, devices, cache, self-test",
            add_doctor},
    Command{"config", "print all settings, and where each comes from", add_config},
    Command{"completion", "print what makes a shell complete commands and options", add_completion},
    Command{"man", "print the manual page", add_man},
};

constexpr const char* kExitCodes =
    "Exit codes:\n"
    "  0  done                               5  output that can't be written\n"
    "  1  rendering or a comparison failed   6  no device, or not the one asked for\n"
    "  2  wrong command line                 7  a kernel doesn't compile on the device\n"
    "  3  invalid scene                      8  too little memory, or a limit\n"
    "  4  input that is missing, unreadable or damaged\n"
    "  130  ended by Ctrl-C; `stress` first reports what it has found\n"
    "  143  ended by SIGTERM\n";

}  // namespace

std::span<const Command> commands() {
    return kCommands;
}

const char* exit_codes_text() {
    return kExitCodes;
}

}  // namespace voxelume::cli
