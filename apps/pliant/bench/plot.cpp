// The plot of `pliant bench`: a self-contained SVG, without scripts or fonts.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

#include "bench/files.hpp"

namespace pliant::tool {
namespace {

struct Point {
    double nodes, least, median, most;  ///< least, median and most: ns per node and step
};
struct Series {
    std::string name;
    bool baseline = false;
    std::vector<Point> points;
};

std::vector<Series> series_of(std::span<const BenchRow> rows)
{
    std::vector<Series> all;
    std::map<std::string, std::size_t> places;
    for (const BenchRow& row : rows) {
        if (!row.in_plot || !row.time || row.time->median <= 0 || row.nodes == 0) continue;
        const bool baseline = row.backend == "serial" || row.backend == "btSoftBody";
        std::string name = (row.series.empty() ? row.subject : row.series) + " · " + row.backend;
        if (row.backend == "cpu")
            name += row.threads == 1 ? ", 1 thread" : ", " + std::to_string(row.threads) + " threads";
        const auto [found, is_new] = places.emplace(name, all.size());
        if (is_new) all.push_back({name, baseline, {}});
        const double scale = 1e6 / static_cast<double>(row.nodes);
        all[found->second].points.push_back({static_cast<double>(row.nodes), scale * row.time->least,
                                             scale * row.time->median, scale * row.time->most});
    }
    for (Series& series : all)
        std::sort(series.points.begin(), series.points.end(),
                  [](const Point& a, const Point& b) { return a.nodes < b.nodes; });
    return all;
}

/// The nearest 1, 2 or 5 times a power of ten above or below a value.
double round_number(double value, bool up)
{
    const double decade = std::pow(10, std::floor(std::log10(value)));
    constexpr double steps[] = {1, 2, 5, 10}, rounding = 1e-9;
    double best = up ? 10 * decade : decade;
    for (const double step : steps) {
        const double candidate = step * decade;
        if (up ? candidate >= value * (1 - rounding) : candidate <= value * (1 + rounding))
            best = up ? std::min(best, candidate) : std::max(best, candidate);
    }
    return best;
}

/// Logarithmic, between round numbers.
struct Axis {
    double low = 0, high = 0, from = 0, to = 0;  ///< range of values, and of their positions

    void cover(double value)
    {
        const double below = round_number(value, false), above = round_number(value, true);
        low = low > 0 ? std::min(low, below) : below;
        high = std::max(high, above);
    }
    void end()  ///< extends it to at least a factor of ten, also if it is empty
    {
        if (low <= 0) low = 1;
        high = std::max(high, 10 * low);
    }
    double at(double value) const
    {
        return from + (to - from) * std::log10(value / low) / std::log10(high / low);
    }
};

std::string number_text(double value)
{
    char text[32];
    if (value >= 1e6)
        std::snprintf(text, sizeof text, "%g M", value / 1e6);
    else if (value >= 1e3)
        std::snprintf(text, sizeof text, "%g k", value / 1e3);
    else
        std::snprintf(text, sizeof text, "%g", value);
    return text;
}

std::string escaped(const std::string& text)
{
    std::string result;
    for (const char c : text)
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return result;
}

// Distinguishable with colour blindness (Okabe and Ito 2008, Color Universal Design).
constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                   "#e69f00", "#56b4e9", "#000000"};

class Plot {
public:
    Plot(std::ostream& out, std::vector<Series> series) : out_(out), series_(std::move(series))
    {
        for (const Series& one : series_)
            for (const Point& p : one.points) {
                x_.cover(p.nodes);
                y_.cover(p.least);
                y_.cover(p.most);
            }
        x_.end();
        y_.end();
        height_ = std::max(480, 120 + 20 * static_cast<int>(series_.size()));
        x_.from = 70, x_.to = 750;
        y_.from = height_ - 60, y_.to = 60;
    }

    void write(const std::string& title)
    {
        out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1100\" height=\"" << height_
             << "\" viewBox=\"0 0 1100 " << height_ << "\" font-family=\"sans-serif\" font-size=\"12\">\n"
             << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
        text(70, 24, "start", "Time of a step: ns per node, over nodes (median, least and largest)",
             "font-size=\"15\"");
        text(70, 44, "start", title, "fill=\"#555\"");
        axis(x_, true);
        axis(y_, false);
        text((x_.from + x_.to) / 2, y_.from + 42, "middle", "nodes");
        out_ << "<text transform=\"translate(22 " << (y_.from + y_.to) / 2
             << ") rotate(-90)\" text-anchor=\"middle\">ns per node and step</text>\n";
        for (std::size_t k = 0; k < series_.size(); ++k) draw(series_[k], k);
        out_ << "</svg>\n";
    }

private:
    void text(double x, double y, const char* anchor, const std::string& words, const char* more = "")
    {
        out_ << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\" " << more << '>'
             << escaped(words) << "</text>\n";
    }
    void line(double x1, double y1, double x2, double y2, const char* style)
    {
        out_ << "<line x1=\"" << x1 << "\" y1=\"" << y1 << "\" x2=\"" << x2 << "\" y2=\"" << y2 << "\" "
             << style << "/>\n";
    }
    void axis(const Axis& axis, bool horizontal)
    {
        const int last = static_cast<int>(std::floor(std::log10(axis.high * 1.001)));
        for (int decade = static_cast<int>(std::floor(std::log10(axis.low))); decade <= last; ++decade) {
            const double one = std::pow(10, decade);
            for (int digit = 1; digit < 10; ++digit) {
                const double value = digit * one;
                if (value < axis.low * 0.999 || value > axis.high * 1.001) continue;
                const double at = axis.at(value);
                const char* style = digit == 1 ? "stroke=\"#bbb\"" : "stroke=\"#eee\"";
                if (horizontal)
                    line(at, y_.from, at, y_.to, style);
                else
                    line(x_.from, at, x_.to, at, style);
                const bool crowded = std::log10(axis.high / axis.low) > 2;
                if (digit != 1 && (crowded || (digit != 2 && digit != 5))) continue;
                if (horizontal)
                    text(at, y_.from + 18, "middle", number_text(value));
                else
                    text(x_.from - 8, at + 4, "end", number_text(value));
            }
        }
    }
    void draw(const Series& series, std::size_t k)
    {
        const std::string colour = colours[k % std::size(colours)];
        const std::string dashes = series.baseline ? " stroke-dasharray=\"5 4\""
                                   : k >= std::size(colours)
                                       ? " stroke-dasharray=\"1 3\" stroke-linecap=\"round\""
                                       : "";
        const std::string stroke = "stroke=\"" + colour + "\" stroke-width=\"2\"" + dashes;
        out_ << "<polyline fill=\"none\" " << stroke << " points=\"";
        for (const Point& p : series.points) out_ << x_.at(p.nodes) << ',' << y_.at(p.median) << ' ';
        out_ << "\"/>\n";
        for (const Point& p : series.points) {
            line(x_.at(p.nodes), y_.at(p.least), x_.at(p.nodes), y_.at(p.most),
                 ("stroke=\"" + colour + '"').c_str());
            out_ << "<circle cx=\"" << x_.at(p.nodes) << "\" cy=\"" << y_.at(p.median)
                 << "\" r=\"3.5\" fill=\"" << (series.baseline ? "white" : colour) << "\" stroke=\"" << colour
                 << "\"/>\n";
        }
        const double y = 70 + 20 * static_cast<double>(k);
        line(770, y, 798, y, stroke.c_str());
        text(806, y + 4, "start", series.name);
    }

    std::ostream& out_;
    std::vector<Series> series_;
    Axis x_, y_;
    int height_ = 0;
};

}  // namespace

void write_plot(AtomicFile& file, const BenchMachine& machine, std::span<const BenchRow> rows)
{
    Plot(file.stream(), series_of(rows))
        .write(machine.name + (machine.quick ? "; --quick: these figures are not meaningful" : ""));
    file.commit();
}

}  // namespace pliant::tool
