// SPDX-License-Identifier: Apache-2.0
// voxelume render: renders images of scenes.
#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "cli/render/render_job.hpp"
#include "cli/render/render_jobs.hpp"
#include "cli/render/render_tally.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/complaint.hpp"
#include "cli/shared/tell.hpp"
#include "cli/shared/warnings.hpp"

namespace voxelume::cli {
namespace {

/// The devices of a run, and the devices that replace them if one fails.
class Devices {
  public:
    Devices(const std::string& chosen, const std::string& fallback)
        : chosen_(chosen), fallback_(fallback), has_fallback_(!fallback.empty()) {}

    void render(const RenderCommand& command, const std::string& label) {
        if (has_failed_) return render_job(command, fallback_, label);
        try {
            render_job(command, chosen_, label);
        } catch (const Error& error) {
            if (!has_fallback_ || !may_be_the_device(error.kind())) throw;
            complain(error.what(), error.kind());
            tell("voxelume: the device of --fallback takes over\n");
            // If one scene is too large for a device, the next one may still fit.
            has_failed_ = error.kind() != ErrorKind::limit;
            render_job(without_finished(command), fallback_, label);
        }
    }

  private:
    static bool may_be_the_device(ErrorKind kind) {
        return kind == ErrorKind::device || kind == ErrorKind::build || kind == ErrorKind::render ||
               kind == ErrorKind::limit;
    }

    /// The command without frames that are already finished; these have the same bits on every
    /// device.
    static RenderCommand without_finished(RenderCommand command) {
        if (command.overwrite == "always") command.overwrite.clear();
        if (command.overwrite.empty()) command.resume = true;
        return command;
    }

    LazyDevices chosen_, fallback_;
    bool has_fallback_;
    bool has_failed_ = false;
};

/// Renders one job after another. A job that fails doesn't stop those after it.
int run_all(const std::vector<RenderJob>& jobs, Devices& devices) {
    const auto start = std::chrono::steady_clock::now();
    const bool is_quiet = jobs.front().command.quiet;
    Tally tally;
    for (size_t i = 0; i < jobs.size(); ++i) {
        const std::string label = fmt::format("{} of {}", i + 1, jobs.size());
        if (!is_quiet) tell("{}: {}\n", label, harmless_line(jobs[i].name));
        try {
            devices.render(jobs[i].command, label);
            ++tally.done;
        } catch (const Error& error) {
            if (error.kind() == ErrorKind::cancelled || error.kind() == ErrorKind::device) throw;
            complain(error.what(), error.kind());
            tally.add(jobs[i].name, error.kind());
        }
    }
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    if (!is_quiet) print_tally(tally, passed.count());
    return tally.failed.empty() ? 0 : static_cast<int>(tally.kind);
}

int run(const RenderCommand& command) {
    if (!command.scene.size.empty()) parse_size(command.scene.size, "render");
    const std::vector<RenderJob> jobs = render_jobs(command);
    for (const RenderJob& job : jobs) check_options(job.command);
    set_limits(command.scene, "render");
    tell_unread_bases(command.quiet);
    Devices devices(command.scene.device, command.fallback);
    if (jobs.size() > 1) return run_all(jobs, devices);
    devices.render(jobs.front().command, "rendering");
    return 0;
}

}  // namespace

Action add_render(CLI::App& app) {
    const auto command = std::make_shared<RenderCommand>();
    const CLI::Option* frames = add_render_options(app, *command);
    return [command, frames] {
        // An empty list would count as not given.
        if (frames->count() > 0 && command->frames.empty()) parse_frame_list(command->frames);
        return run(*command);
    };
}

}  // namespace voxelume::cli
