// SPDX-License-Identifier: MIT
#pragma once

// A rendering from the first sample to the last: checkpoints, rules that stop it, parts. It prints nothing and touches no
// signals: what it has to say goes to callbacks, and what ends it is an exception.

#include "plumb/base/error.h"
#include "plumb/render/evidence.h"
#include "plumb/rendering/task.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace plumb {

// Why a rendering ended.
enum class StopReason { all_samples, time_limit, target_error, interrupted };

struct SessionCallbacks {
    std::function<void(const Progress&)> progress = {}; // from one thread at a time
    TileReport tile = {}; // from all threads: pixels with more samples than before
    // What does not end the rendering: warnings ("a damaged checkpoint was skipped") and notes.
    std::function<void(const Diagnostic&)> message = {};
    // Read from all threads, for each row of a tile; a signal handler may set it.
    const std::atomic<bool>* stop = nullptr;

    bool is_stopped() const { return stop && *stop; }
};

// One of the parts of an image, from 0.
struct PartSettings {
    std::uint64_t index = 0;
    std::uint64_t count = 1;
    PartBy by = PartBy::tiles;
    friend bool operator==(const PartSettings&, const PartSettings&) = default;
};

struct CheckpointSettings {
    std::filesystem::path file = {}; // .exr; empty: none
    double every_seconds = 60.0;
};

// Samples that an image has, to be taken once more.
struct SamplesAgain {
    SampleSet samples;
    std::string stop = {}; // Evidence::stop of that image
};

// Of a run; never in a header.
struct SessionOptions {
    int threads = 0; // 0: all
    CheckpointSettings checkpoint = {};
    std::optional<PartSettings> part = {};
    std::optional<SamplesAgain> again = {}; // these, and no rules
};

class RenderSession {
public:
    // Throws Error if the settings make no sense together.
    explicit RenderSession(RenderTask task, SessionOptions options = {}, SessionCallbacks callbacks = {});
    RenderSession(const RenderSession&) = delete;
    RenderSession& operator=(const RenderSession&) = delete;
    ~RenderSession();

    // Resumes from the checkpoint, or from the one before if that is damaged; false: there is neither. Throws Error if it is of
    // another work, with what has changed.
    bool resume();
    // Takes samples until all are taken, a rule says so or somebody stops it; then it may be called again. Writes checkpoints
    // now and then; one that cannot be written is a warning.
    StopReason run();
    // Writes the checkpoint, and keeps the one before. Throws Error. May be called while another thread makes the image.
    void save() const;

    const RenderTask& task() const;
    const RenderState& state() const;
    Evidence evidence() const;
    Image image(
        const Evidence& evidence) const; // with its header, and with error bars if the settings say so
    Image image() const { return image(evidence()); }

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace plumb
