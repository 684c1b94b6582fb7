// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_jobs.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "cli/output/output_names.hpp"
#include "cli/output/output_stream.hpp"
#include "cli/render/sweep.hpp"
#include "cli/shared/checks.hpp"

namespace voxelume::cli {
namespace {

constexpr const char* kFrame = "####";  // replaces {frame} until the frame is known

/// The name of an input as it appears in outputs' names, where # stands for a frame.
std::string name_of_input(const std::string& input) {
    if (input == "-") return "stdin";
    std::string name = std::filesystem::path(input).stem().string();
    std::ranges::replace(name, '#', '_');
    return name;
}

/// The properties in which jobs differ.
struct Variant {
    std::string input;
    size_t view = 0;    ///< from 0
    size_t number = 0;  ///< number of the combination of values, from 0
    std::vector<std::string> values;
};

/// Makes the jobs of one command.
class JobList {
  public:
    explicit JobList(const RenderCommand& command) : command_(command) {
        for (const std::string& text : command.sweeps)
            sweeps_.push_back(parse_sweep(text, "render"));
        combinations_ = combinations(sweeps_, "render");
        views_ = size_t(std::max(command.views, 1));
    }

    std::vector<RenderJob> make() {
        std::vector<RenderJob> jobs;
        for (const std::string& input : command_.inputs)
            for (size_t view = 0; view < views_; ++view)
                for (size_t n = 0; n < combinations_.size(); ++n)
                    jobs.push_back(job({input, view, n, combinations_[n]}));
        refuse_shared_stream(jobs);
        refuse_shared_files(jobs);
        return jobs;
    }

  private:
    Placeholders placeholders(const Variant& variant) const {
        Placeholders list = {{"name", name_of_input(variant.input)}, {"frame", kFrame}};
        if (command_.views > 0)
            list.emplace_back("view", padded(variant.view + 1, views_));
        else if (!command_.scene.import.view.empty())
            list.emplace_back("view", file_part(command_.scene.import.view));
        // The eye is known only when the file is written.
        if (command_.quilt.stereo > 0) list.emplace_back("eye", kEye);
        if (sweeps_.empty()) return list;
        list.emplace_back("sweep", padded(variant.number + 1, combinations_.size()));
        for (size_t i = 0; i < sweeps_.size(); ++i) {
            const std::string text = file_part(variant.values[i]), &path = sweeps_[i].path;
            list.emplace_back(path, text);
            const auto has_key = [&](const Sweep& sweep) {
                return last_key(sweep.path) == last_key(path);
            };
            if (std::ranges::count_if(sweeps_, has_key) == 1 && last_key(path) != path)
                list.emplace_back(last_key(path), text);
        }
        return list;
    }

    RenderJob job(const Variant& variant) const {
        RenderJob job{variant.input, command_};
        RenderCommand& command = job.command;
        command.scene.scene = variant.input;
        if (command_.views > 0) {
            command.scene.has_views = true;
            command.scene.orbit = 360.0 * double(variant.view) / command_.views;
            job.name += fmt::format(", view {}", variant.view + 1);
        }
        for (size_t i = 0; i < sweeps_.size(); ++i) {
            command.scene.swept.push_back(sweeps_[i].path + "=" + variant.values[i]);
            job.name += fmt::format(", {}={}", last_key(sweeps_[i].path), variant.values[i]);
        }
        const Placeholders texts = placeholders(variant);
        for (auto* patterns : {&command.outputs, &command.volumes})
            for (std::string& pattern : *patterns) pattern = fill_in(pattern, texts, "render");
        for (std::string* pattern : {&command.stats, &command.earlier})
            *pattern = fill_in(*pattern, texts, "render");
        return job;
    }

    /// Names the placeholders that would make the files of two jobs differ, or says why none would.
    std::string advice(const RenderJob& a, const RenderJob& b) const {
        const std::string &first = a.command.scene.scene, &second = b.command.scene.scene;
        if (first == second && views_ * combinations_.size() == 1)
            return "the input stands twice in the call";
        if (first != second && name_of_input(first) == name_of_input(second))
            return "inputs of one {name} can't be told apart; render them in calls of their own";
        std::vector<std::string> names;
        if (command_.inputs.size() > 1) names.emplace_back("{name}");
        if (views_ > 1) names.emplace_back("{view}");
        if (combinations_.size() > 1)
            for (const Sweep& sweep : sweeps_) names.push_back("{" + placeholder(sweep) + "}");
        return fmt::format("have {} in its name", fmt::join(names, " and "));
    }

    /// The placeholder that distinguishes a sweep's values in a file's name: the sweep's key or, if
    /// that has another meaning or the values look alike, the combination's number.
    std::string placeholder(const Sweep& sweep) const {
        const std::string key = last_key(sweep.path);
        std::set<std::string> parts;
        for (const std::string& value : sweep.values) parts.insert(file_part(value));
        const bool is_taken = key == "name" || key == "frame" || key == "view" ||
                              (key == "eye" && command_.quilt.stereo > 0);
        return is_taken || parts.size() < sweep.values.size() ? "sweep" : key;
    }

    static void refuse_shared_stream(const std::vector<RenderJob>& jobs) {
        if (jobs.size() > 1 && std::ranges::any_of(jobs.front().command.outputs, is_stream))
            fail_usage("render: -o -: standard output takes one image, not {}", jobs.size());
    }

    void refuse_shared_files(const std::vector<RenderJob>& jobs) const {
        std::map<std::filesystem::path, const RenderJob*> known;
        for (const RenderJob& job : jobs) {
            std::vector<std::string> files = job.command.outputs;
            files.insert(files.end(), job.command.volumes.begin(), job.command.volumes.end());
            files.push_back(job.command.stats);
            for (const std::string& file : files) {
                if (file.empty()) continue;
                for (const std::filesystem::path& one : files_of_eyes(file, job.command.quilt)) {
                    const auto [first, is_new] = known.emplace(real_path(one), &job);
                    if (is_new || first->second == &job) continue;
                    fail_usage("render: {}: this would be the output of both {} and {}; {}",
                               one.string(), first->second->name, job.name,
                               advice(*first->second, job));
                }
            }
        }
    }

    const RenderCommand& command_;
    std::vector<Sweep> sweeps_;
    std::vector<std::vector<std::string>> combinations_;
    size_t views_ = 1;
};

}  // namespace

std::vector<RenderJob> render_jobs(const RenderCommand& command) {
    return JobList(command).make();
}

}  // namespace voxelume::cli
