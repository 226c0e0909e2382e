// SPDX-License-Identifier: MIT
#pragma once

// --exposure and --tonemap of verbs that develop an image: what is not given is as the image's header says.

#include "cli/verb_file.h"

#include <optional>

namespace plumb {

struct DevelopmentOptions {
    std::optional<float> exposure;
    std::optional<ToneCurve> curve;

    bool any() const { return exposure || curve; }
};

// Of a header whose settings cannot be read, the defaults.
Development development_of(const Metadata& header, const DevelopmentOptions& options);

// As the settings of these names have it.
inline RenderSettings one_setting(std::string_view row, std::string_view called, const std::string& text)
{
    RenderSettings settings;
    find_setting<RenderSettings>(row)->set(settings, called, text);
    return settings;
}

template <class Options>
OptionTable<Options> development_options(DevelopmentOptions Options::*member)
{
    return {{{Topic::image, "--exposure", "STOPS",
              "multiply colours by 2^STOPS (default: the header's, or 0)", false, false},
             [member](Options& o, std::string_view n, const std::string& t) {
                 (o.*member).exposure = one_setting("exposure", n, t).output.development.exposure;
             }},
            {{Topic::image, "--tonemap", "CURVE",
              "tone curve: none, filmic, aces or agx (default: the\nheader's, or none)", false, false},
             [member](Options& o, std::string_view n, const std::string& t) {
                 (o.*member).curve = one_setting("tonemap", n, t).output.development.curve;
             }}};
}

} // namespace plumb
