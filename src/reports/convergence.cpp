// SPDX-License-Identifier: MIT

// Curves of convergence as a table and as a drawing.

#include "base/text.h"
#include "plumb/reports/race_report.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumb {

namespace {

// Of a plot, in the units of the drawing.
constexpr double plot_width = 400.0;
constexpr double plot_height = 300.0;
constexpr double left_margin = 70.0;
constexpr double top_margin = 40.0;
constexpr double gap = 80.0;
constexpr double legend_line = 20.0;

constexpr std::string_view colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                       "#e69f00", "#56b4e9", "#999933", "#882255"};

std::string escaped(std::string_view text)
{
    std::string all;
    for (const char c : text) {
        switch (c) {
        case '&': all += "&amp;"; break;
        case '<': all += "&lt;"; break;
        case '>': all += "&gt;"; break;
        case '"': all += "&quot;"; break;
        default: all += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    }
    return all;
}

// A logarithmic axis over all numbers that are added.
class Axis {
public:
    void add(double value)
    {
        if (!(value > 0.0) || !std::isfinite(value)) return;
        low_ = std::min(low_, value);
        high_ = std::max(high_, value);
    }
    bool empty() const { return !(low_ <= high_); }
    void finish() // with some room
    {
        low_ /= 1.15;
        high_ *= 1.15;
    }
    double place(double value) const // from 0 to 1
    {
        return std::clamp(std::log(value / low_) / std::log(high_ / low_), 0.0, 1.0);
    }
    // Powers of ten, and between them too where there are few.
    std::vector<double> ticks() const
    {
        const bool has_few = high_ / low_ < 30.0;
        std::vector<double> all;
        for (int decade = static_cast<int>(std::floor(std::log10(low_))); std::pow(10.0, decade) <= high_;
             ++decade)
            for (const double factor : {1.0, 2.0, 5.0})
                if (const double tick = factor * std::pow(10.0, decade);
                    tick >= low_ && tick <= high_ && (has_few || factor == 1.0))
                    all.push_back(tick);
        return all;
    }

private:
    double low_ = HUGE_VAL;
    double high_ = 0.0;
};

double seconds_of(const CurvePoint& point)
{
    return point.seconds;
}

double samples_of(const CurvePoint& point)
{
    return static_cast<double>(point.samples);
}

using Abscissa = double (*)(const CurvePoint&);

class Plot {
public:
    Plot(const RaceResult& race, Abscissa abscissa, std::string title, double left)
        : race_(race), abscissa_(abscissa), title_(std::move(title)), left_(left)
    {
        for (const RaceRow& row : race.ranking)
            for (const CurvePoint& point : row.curve) {
                if (!point.rmse) continue;
                x_.add(abscissa(point));
                y_.add(point.rmse->value);
            }
        x_.finish();
        y_.finish();
    }

    std::string svg() const
    {
        if (x_.empty()) return {};
        std::string text;
        for (const double tick : x_.ticks()) {
            const double x = left_ + x_.place(tick) * plot_width;
            text += line(x, top_margin, x, top_margin + plot_height, "grid") +
                    label(x, top_margin + plot_height + 16.0, "middle", fmt::format("{:g}", tick));
        }
        for (const double tick : y_.ticks()) {
            const double y = top_margin + (1.0 - y_.place(tick)) * plot_height;
            text += line(left_, y, left_ + plot_width, y, "grid") +
                    label(left_ - 6.0, y + 4.0, "end", fmt::format("{:g}", tick));
        }
        text += fmt::format("<rect x='{}' y='{}' width='{}' height='{}' class='frame'/>\n", left_, top_margin,
                            plot_width, plot_height);
        text += label(left_ + plot_width / 2.0, top_margin + plot_height + 36.0, "middle", title_);
        text += label(left_, top_margin - 8.0, "start", "RMSE");
        for (std::size_t i = 0; i < race_.ranking.size(); ++i) text += curve(race_.ranking[i].curve, i);
        return text;
    }

private:
    static std::string line(double x1, double y1, double x2, double y2, std::string_view kind)
    {
        return fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' class='{}'/>\n", x1, y1, x2,
                           y2, kind);
    }
    static std::string label(double x, double y, std::string_view anchor, std::string_view text)
    {
        return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}'>{}</text>\n", x, y, anchor, text);
    }
    std::string point(double x, double y) const
    {
        return fmt::format("{:.1f},{:.1f}", left_ + x_.place(x) * plot_width,
                           top_margin + (1.0 - y_.place(y)) * plot_height);
    }
    // With its intervals behind it.
    std::string curve(const std::vector<CurvePoint>& curve, std::size_t index) const
    {
        std::vector<std::string> middle, low, band;
        std::string dots;
        for (const CurvePoint& at : curve) {
            if (!at.rmse) continue;
            const double x = abscissa_(at);
            middle.push_back(point(x, at.rmse->value));
            band.push_back(point(x, at.rmse->high));
            low.push_back(point(x, at.rmse->low));
            const std::size_t comma = middle.back().find(',');
            dots +=
                fmt::format("<circle cx='{}' cy='{}' r='2.5' class='c{}'/>\n", middle.back().substr(0, comma),
                            middle.back().substr(comma + 1), index % std::size(colors));
        }
        band.insert(band.end(), low.rbegin(), low.rend());
        return fmt::format(
            "<polygon points='{}' class='band c{}'/>\n<polyline points='{}' class='curve c{}'/>\n{}",
            fmt::join(band, " "), index % std::size(colors), fmt::join(middle, " "),
            index % std::size(colors), dots);
    }

    const RaceResult& race_;
    Abscissa abscissa_;
    std::string title_;
    double left_;
    Axis x_, y_;
};

std::string style()
{
    std::string text = "<style>\n"
                       "text { font: 13px sans-serif; fill: #222 }\n"
                       ".paper { fill: #fff } .frame { fill: none; stroke: #888 } .grid { stroke: #ddd }\n"
                       ".curve { fill: none !important; stroke-width: 1.6 } .band { opacity: 0.18; stroke: "
                       "none !important }\n";
    for (std::size_t i = 0; i < std::size(colors); ++i)
        text += fmt::format(".c{} {{ stroke: {}; fill: {} }}\n", i, colors[i], colors[i]);
    return text + "@media (prefers-color-scheme: dark) { text { fill: #ddd } .paper { fill: #16181b } .grid "
                  "{ stroke: #333 } }\n"
                  "</style>\n";
}

} // namespace

std::string convergence_csv(const RaceResult& race)
{
    std::string text = "estimator,samples_per_pixel,seconds,rmse,rmse_low,rmse_high,images\n";
    for (const RaceRow& row : race.ranking) {
        std::string name = "\"";
        for (const char c : row.name) name += c == '"' ? "\"\"" : std::string(1, c);
        for (const CurvePoint& point : row.curve)
            text += fmt::format(
                "{}\",{},{},{},{}\n", name, point.samples, point.seconds,
                point.rmse ? fmt::format("{},{},{}", point.rmse->value, point.rmse->low, point.rmse->high)
                           : ",,",
                race.rounds);
    }
    return text;
}

std::string convergence_svg(const std::string& scene, const RaceResult& race)
{
    const double width = left_margin + 2.0 * plot_width + gap + 20.0;
    const double legend_top = top_margin + plot_height + 60.0;
    const double height = legend_top + legend_line * static_cast<double>(race.ranking.size()) + 10.0;
    std::string text =
        fmt::format(
            "<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{1}' viewBox='0 0 {0} {1}'>\n"
            "<title>{2}: error of {3} images each</title>\n",
            width, height, escaped(scene), race.rounds) +
        style() + fmt::format("<rect width='{}' height='{}' class='paper'/>\n", width, height) +
        Plot(race, samples_of, "samples per pixel", left_margin).svg() +
        Plot(race, seconds_of, "seconds per image", left_margin + plot_width + gap).svg();
    double y = legend_top;
    for (std::size_t i = 0; i < race.ranking.size(); ++i, y += legend_line)
        text += fmt::format("<line x1='{0}' y1='{1}' x2='{2}' y2='{1}' class='curve c{3}'/>\n"
                            "<text x='{4}' y='{5}'>{6}</text>\n",
                            left_margin, y, left_margin + 24.0, i % std::size(colors), left_margin + 32.0,
                            y + 4.0, escaped(race.ranking[i].name));
    return text + "</svg>\n";
}

} // namespace plumb
