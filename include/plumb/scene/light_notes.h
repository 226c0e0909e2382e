// SPDX-License-Identifier: MIT
#pragma once

// How a camera sample found its light, contribution by contribution, for images of parts of the light (light_split.h).

#include "plumb/math/color.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace plumb {

// view: the camera sees the emitter, directly or by delta bounces alone, so there is no choice of techniques.
enum class FoundBy { view, emitter_sample, direction };

// The emitter of light that comes from all infinite emitters together.
inline constexpr std::uint32_t environment_index = UINT32_MAX;

struct LightNote {
    Color sum; // of the light up to and with this contribution
    FoundBy by = FoundBy::view;
    std::uint32_t emitter = 0; // into Scene::emitters(), or environment_index
    int depth = 0;             // surface bounces between the camera and the emitter
};

// An integrator sums up contributions, perhaps in sums of sums. It notes each value of the innermost sum as it is computed.
// Whatever it then does to that sum, it does to the notes, with the same operations. So the last note is what the sample
// found, bit for bit, and the difference of two neighbours is what a contribution adds to it.
class LightNotes {
public:
    void clear() { notes_.clear(); }
    std::size_t count() const { return notes_.size(); }
    const std::vector<LightNote>& all() const { return notes_; }

    void add(const LightNote& note) { notes_.push_back(note); }
    // Of the notes from number `first` on. map: of a sum; it must not decrease anything, and make of 0 what was there before
    // them.
    template <class Map>
    void change_sums(std::size_t first, const Map& map)
    {
        for (std::size_t i = first; i < notes_.size(); ++i) notes_[i].sum = map(notes_[i].sum);
    }
    // Forgets the notes from number `first` on; the emitter of the last of them.
    std::optional<std::uint32_t> take_back(std::size_t first)
    {
        if (first >= notes_.size()) return std::nullopt;
        const std::uint32_t emitter = notes_.back().emitter;
        notes_.resize(first);
        return emitter;
    }
    void set_depth(std::size_t first, int depth)
    {
        for (std::size_t i = first; i < notes_.size(); ++i) notes_[i].depth = depth;
    }

private:
    std::vector<LightNote> notes_;
};

} // namespace plumb
