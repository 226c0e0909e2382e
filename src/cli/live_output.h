// SPDX-License-Identifier: MIT
#pragma once

// What shows an image while it is rendered: a viewer (--tev), and a picture in the terminal (--preview).

#include "cli/verb_file.h"

#include "plumb/display/live_view.h"
#include "plumb/display/preview.h"
#include "plumb/display/terminal_picture.h"
#include "plumb/rendering/session.h"

#include <optional>

namespace plumb {

struct LiveOptions {
    std::optional<ViewerAddress> viewer;
    bool preview = false;
    std::optional<TerminalGraphics> graphics; // absent: what the terminal can do

    bool any() const { return viewer || preview; }
};

class LiveOutput {
public:
    // What there is of the image already is shown. Without a terminal there is no picture in it.
    LiveOutput(const LiveOptions& options, const RenderTask& task, const RenderState& state);

    void show(const Film& film, const PixelRect& part); // from any thread
    // Once, why the viewer shows nothing (any more).
    std::optional<std::string> take_problem();
    const Preview* preview() const { return preview_ ? &*preview_ : nullptr; }

private:
    std::size_t channels_;
    std::optional<LiveView> viewer_;
    std::optional<Preview> preview_;
};

// As options of verbs.
void set_viewer(LiveOptions& options, std::string_view name, const std::string& text);
void set_preview(LiveOptions& options, std::string_view name, const std::string& text);

template <class Options>
OptionTable<Options> live_options(LiveOptions Options::*member)
{
    return {
        {{Topic::output, "--tev", "HOST:PORT",
          "show the image in tev or HDRView while it is\nrendered (default 127.0.0.1:14158)", false, false,
          true},
         [member](Options& o, std::string_view n, const std::string& t) { set_viewer(o.*member, n, t); }},
        {{Topic::output, "--preview", "HOW",
          "show the image in the terminal: blocks, sixel or\nkitty (default: what the terminal can do)",
          false, false, true},
         [member](Options& o, std::string_view n, const std::string& t) { set_preview(o.*member, n, t); }}};
}

} // namespace plumb
