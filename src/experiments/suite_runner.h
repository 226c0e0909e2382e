// SPDX-License-Identifier: MIT
#pragma once

// One job of a suite after the other.

#include "experiments/suite_state.h"
#include "plumb/experiments/suite_run.h"
#include "rendering/output_files.h"

#include <map>
#include <memory>
#include <set>

namespace plumb {

class SuiteRunner {
public:
    SuiteRunner(const std::filesystem::path& suite, const std::vector<SuiteJob>& jobs,
                const SuiteOptions& options, const SessionCallbacks& callbacks);

    // Never throws: what goes wrong is in the result.
    SuiteResult run(const SuiteJob& job);
    SuiteImages images() const; // of the last job

private:
    struct Made {
        Image image;
        Evidence evidence;
    };

    void do_job(const SuiteJob& job, SuiteResult& result);
    SuiteResult result_of(const SuiteJob& job) const;

    // Entries that are next to each other often have one scene.
    RenderTask task_of(const SuiteEntry& entry, const RenderSettings& settings);
    // Half an image is neither a result nor a reference.
    Made render_whole(const RenderTask& task, const std::vector<std::string>& files, SuiteResult& result);

    // Images: suite_images.cpp.
    void make_image(const SuiteJob& job, SuiteResult& result);
    void run_program(const SuiteJob& job, SuiteResult& result);
    void take_image(const SuiteJob& job, SuiteResult& result);
    void show_foreign(const SuiteJob& job, const std::vector<std::string>& files, std::vector<Image> images,
                      SuiteResult& result);
    void require_reference(const SuiteEntry& entry) const; // throws SceneError if it does not exist
    std::string counted_title(const SuiteEntry& entry, const RenderTask& task);
    void compare_with_reference(const SuiteJob& job, SuiteResult& result);
    void write_maps(const Image& image, const Image& reference, const std::string& stem, SuiteResult& result);
    void prepare_outputs(const SuiteJob& job, const std::string& stem, std::vector<std::string> files) const;
    std::string stem_of(const std::string& title) const { return (options_.directory / title).string(); }

    // References: suite_references.cpp.
    void make_reference(const SuiteJob& job, SuiteResult& result);
    void check_reference(const SuiteJob& job, SuiteResult& result);
    void note_stale(const SuiteJob& job, const Image& reference, SuiteResult& result);
    std::vector<std::string> stale_reasons(const SuiteJob& maker, const Image& reference,
                                           SuiteResult& result);
    // The entry that makes the reference of a job: the first one with a scene. Null: it comes from elsewhere.
    const SuiteJob* maker_of(const SuiteJob& job) const;
    void compare_references(const SuiteJob& job, Image now, Image before, SuiteResult& result);
    std::string suite_command(const std::string& words) const;

    const std::filesystem::path& suite_;
    const std::vector<SuiteJob>& jobs_;
    const SuiteOptions& options_;
    const SessionCallbacks& callbacks_;
    SuiteState state_;
    KeptFiles kept_;               // that no image may replace
    std::set<std::string> titles_; // that are taken
    std::unique_ptr<SceneFile> last_;
    std::map<std::filesystem::path, std::vector<std::string>> stale_; // of the references looked at so far
    std::optional<Image> image_, reference_;                          // of the last job
};

} // namespace plumb
