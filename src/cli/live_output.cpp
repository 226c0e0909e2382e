// SPDX-License-Identifier: MIT
#include "cli/live_output.h"

#include "cli/console.h"
#include "plumb/base/error.h"

#include <filesystem>

namespace plumb {

LiveOutput::LiveOutput(const LiveOptions& options, const RenderTask& task, const RenderState& state)
    : channels_(state.film.channel_names().size())
{
    const PixelRect& window = state.film.window();
    const Vec2i size = task.scene.job.camera->resolution();
    if (options.viewer)
        viewer_.emplace(*options.viewer, std::filesystem::path(task.name).filename().string(), size.x, size.y,
                        state.film.channel_names());
    if (options.preview && log_is_terminal()) preview_.emplace(window, task.settings.output.development);
    if (!state.taken.empty()) show(state.film, window);
}

void LiveOutput::show(const Film& film, const PixelRect& part)
{
    std::vector<float> values = film.develop(part);
    if (preview_) preview_->update(part, values, channels_);
    if (viewer_) viewer_->update(part, std::move(values));
}

std::optional<std::string> LiveOutput::take_problem()
{
    return viewer_ ? viewer_->take_problem() : std::nullopt;
}

// A value is optional; its absence arrives as "true".
constexpr std::string_view no_value = "true";

void set_viewer(LiveOptions& options, std::string_view name, const std::string& text)
{
    try {
        options.viewer = text == no_value ? ViewerAddress() : viewer_address(text);
    } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", name, error.what()));
    }
}

void set_preview(LiveOptions& options, std::string_view name, const std::string& text)
{
    options.preview = true;
    if (text == no_value) return;
    const std::string word = parse_word(name, text, {"blocks", "sixel", "kitty"});
    options.graphics = word == "blocks"  ? TerminalGraphics::blocks
                       : word == "sixel" ? TerminalGraphics::sixel
                                         : TerminalGraphics::kitty;
}

} // namespace plumb
