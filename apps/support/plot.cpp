#include "plot.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace study {

namespace {

std::string gnuplot_string(std::string text) {
    for (std::size_t i = text.find('\''); i != std::string::npos; i = text.find('\'', i + 2)) text.insert(i, 1, '\'');
    return "'" + text + "'";
}

/// "α_T" for the column alpha_T.
std::string with_greek(std::string name) {
    for (const auto& [word, letter] : {std::pair{"alpha", "α"}, {"lambda", "λ"}, {"epsilon", "ε"}}) {
        if (name.rfind(word, 0) == 0) name.replace(0, std::string_view(word).size(), letter);
    }
    return name;
}

std::string number_text(double number) {
    std::array<char, 32> buffer;
    return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr};
}

/// Ticks of a logarithmic x axis: at the x values where they are few, such as numbers of elements, else as gnuplot sets
/// them, at powers of the base, unless fewer than two of those lie on the axis. Empty for gnuplot's ticks.
std::string logarithmic_ticks(const Plot& plot) {
    std::set<double> values;
    for (const Series& series : plot.series) {
        for (const auto& point : series.points) {
            if (point.first > 0) values.insert(point.first);
        }
    }
    if (plot.x_range) values = {plot.x_range->low, plot.x_range->high};
    if (values.empty() || !(*values.begin() > 0)) return "";
    const double low = *values.begin(), high = *values.rbegin(), base = plot.log_base;
    constexpr double share = 0.04;  // of the axis: closer ticks run into each other
    bool apart = values.size() <= 12 && !plot.x_range;
    for (auto value = values.begin(); apart && std::next(value) != values.end(); ++value) {
        apart = std::log(*std::next(value) / *value) > share * std::log(high / low);
    }
    std::vector<double> ticks(values.begin(), values.end());
    if (!apart) {
        const double first = std::ceil(std::log(low) / std::log(base) - 1e-9);
        if (std::pow(base, first + 1) <= high * (1 + 1e-9)) return "";
        ticks.clear();
        const double decade = std::pow(10.0, std::floor(std::log10(low)));
        for (const double tick : {1, 2, 3, 5, 7, 10, 20, 30, 50, 70}) {
            if (tick * decade >= low && tick * decade <= high) ticks.push_back(tick * decade);
        }
        if (ticks.size() < 2) ticks = {low, high};
    }
    std::string text;
    for (const double tick : ticks) text += (text.empty() ? "" : ",") + number_text(tick);
    return text;
}

std::string panel_script(const Plot& plot) {
    constexpr std::array colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
    constexpr std::array dashes{"1", "(12,6)", "(3,4)", "(12,5,3,5)", "(20,6,6,6)"};
    constexpr std::array markers{7, 5, 9, 13, 6, 4, 8, 12};
    const auto usable = [&](const std::pair<double, double>& point) {
        return (!plot.log_x || point.first > 0) && (!plot.log_y || point.second > 0);
    };
    const auto is_counted = [](const Series& series) { return !series.label.empty() && !series.reference; };
    const auto labelled = static_cast<std::size_t>(std::count_if(plot.series.begin(), plot.series.end(), is_counted));
    std::string title = plot.title;
    if (labelled > most_curves) {
        title += (title.empty() ? "" : ": ") + ("the first " + std::to_string(most_curves)) + " of " +
                 std::to_string(labelled) + " curves";
    }
    std::string script;
    script += "set title " + gnuplot_string(title) + "\nset xlabel " + gnuplot_string(plot.x_label) + "\nset ylabel " +
              gnuplot_string(plot.y_label) + "\nset grid lt 1 lc rgb '#dddddd' lw 1\n";
    script += "set key above\nset autoscale xfix\nset format '%h'\n";
    for (const auto& [axis, is_log] : {std::pair{"x", plot.log_x}, std::pair{"y", plot.log_y}}) {
        if (is_log) script += "set logscale " + std::string(axis) + " " + std::to_string(plot.log_base) + "\n";
    }
    for (const auto& [axis, range] : {std::pair{"x", plot.x_range}, std::pair{"y", plot.y_range}}) {
        if (!range) continue;
        script +=
            "set " + std::string(axis) + "range [" + number_text(range->low) + ":" + number_text(range->high) + "]\n";
    }
    if (plot.log_x) {
        const std::string ticks = logarithmic_ticks(plot);
        if (!ticks.empty()) script += "set xtics (" + ticks + ")\nset offsets graph 1e-6, graph 1e-6, 0, 0\n";
    }
    std::string commands;
    std::size_t drawn = 0;  // of those with a label
    for (std::size_t k = 0; k < plot.series.size(); ++k) {
        const Series& series = plot.series[k];
        if (std::none_of(series.points.begin(), series.points.end(), usable)) continue;
        if (is_counted(series) && ++drawn > most_curves) continue;
        const std::string data = "$data" + std::to_string(k);
        script += data + " << EOD\n";
        for (const auto& point : series.points) {
            if (usable(point)) script += number_text(point.first) + " " + number_text(point.second) + "\n";
        }
        script += "EOD\n";
        const std::string kind = !series.markers ? "lines" : series.line ? "linespoints" : "points";
        const std::size_t style = series.style.value_or(k);
        commands += (commands.empty() ? "plot " : ", ") + data + " with " + kind + " lw 2 lc rgb '" +
                    colours[style % colours.size()] + "'";
        if (series.line) commands += " dt " + std::string(dashes[style % dashes.size()]);
        if (series.markers) commands += " pt " + std::to_string(markers[style % markers.size()]);
        commands += series.label.empty() ? " notitle" : " title " + gnuplot_string(series.label);
    }
    if (commands.empty()) throw PlotError("the plot has no point to draw");
    return script + commands + "\n";
}

std::string gnuplot_script(const Plot& plot, bool png) {
    const std::size_t panels = 1 + plot.beside.size();
    const auto size = [&](std::size_t width, std::size_t height) {
        return "size " + std::to_string(panels * width) + "," + std::to_string(height) + " ";
    };
    std::string script = "set encoding utf8\n";
    if (png) {
        script += "if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) set terminal pngcairo " + size(1200, 800) +
                  "enhanced font 'sans,16' background '#ffffff'; else set terminal png " + size(1200, 800) +
                  "enhanced background '#ffffff'\n";
    } else {
        script += "set terminal svg " + size(900, 600) + "dynamic enhanced font 'sans,14' background '#ffffff'\n";
    }
    if (panels > 1) script += "set multiplot layout 1," + std::to_string(panels) + "\n";
    script += panel_script(plot);
    for (const Plot& panel : plot.beside) script += "reset\n" + panel_script(panel);
    if (panels > 1) script += "unset multiplot\n";
    return script;
}

/// What gnuplot writes when it runs `script`. It goes through a pipe, not into the file: gnuplot does not tell when a
/// write fails.
std::string run_gnuplot(std::string_view script, const std::string& path) {
    const auto fail = [&](const std::string& why) -> void {
        throw PlotError("--plot = " + path + why + "; the rows are written");
    };
    std::array<int, 2> input{}, output{};
    if (::pipe2(input.data(), O_CLOEXEC) != 0) fail(std::string(": no pipe to gnuplot: ") + std::strerror(errno));
    if (::pipe2(output.data(), O_CLOEXEC) != 0) {
        const int error = errno;
        for (const int end : input) ::close(end);
        fail(std::string(": no pipe from gnuplot: ") + std::strerror(error));
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::string program = "gnuplot";
    std::array<char*, 2> arguments{program.data(), nullptr};
    pid_t child = 0;
    const int error = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(input[0]);
    ::close(output[1]);
    if (error != 0) {
        ::close(input[1]);
        ::close(output[0]);
        fail(std::string(" needs gnuplot, which cannot be started (") + std::strerror(error) + ")");
    }
    std::thread writer([script, to = input[1]] {  // gnuplot may draw before it has read everything
        std::string_view rest = script;
        while (!rest.empty()) {  // a gnuplot that dies early shows in its status
            const ssize_t written = ::write(to, rest.data(), rest.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) break;
            rest.remove_prefix(static_cast<std::size_t>(written));
        }
        ::close(to);
    });
    std::string picture;
    std::array<char, 65536> buffer;
    ssize_t count = 0;
    while ((count = ::read(output[0], buffer.data(), buffer.size())) != 0) {
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) break;
        picture.append(buffer.data(), static_cast<std::size_t>(count));
    }
    ::close(output[0]);
    writer.join();
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    if (count < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0) fail(": gnuplot failed");
    return picture;
}

/// Whether a picture has its end.
bool is_whole(std::string_view picture, bool png) {
    using namespace std::string_view_literals;
    const std::string_view end = png ? "\0\0\0\0IEND\xAE\x42\x60\x82"sv : "</svg>"sv;
    while (!png && !picture.empty() && std::isspace(static_cast<unsigned char>(picture.back())) != 0) {
        picture.remove_suffix(1);
    }
    return picture.size() >= end.size() && picture.substr(picture.size() - end.size()) == end;
}

}  // namespace

void add_series(Plot& plot, const std::vector<std::string>& columns, const std::vector<Row>& rows,
                const Selection& selection) {
    const auto column = [&](const std::string& name) {
        return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
    };
    std::vector<std::string> names = selection.by;
    names.insert(names.end(), selection.apart.begin(), selection.apart.end());
    std::map<std::vector<std::string>, std::size_t> found;
    std::vector<std::vector<std::string>> keys;
    std::vector<Series> series;
    for (const Row& row : rows) {
        std::vector<std::string> key;
        for (const std::string& name : names) key.push_back(row[column(name)].text(6));
        const auto [position, is_new] = found.try_emplace(key, series.size());
        if (is_new) {
            keys.push_back(key);
            series.emplace_back();
        }
        const std::optional<double> x = row[column(selection.x)].number(), y = row[column(selection.y)].number();
        if (x && y) series[position->second].points.emplace_back(*x, selection.absolute ? std::abs(*y) : *y);
    }
    const auto append = [](std::string& text, const std::string& name, const std::string& value) {
        if (value.empty()) return;
        const bool speaks = value.find_first_not_of("0123456789.+-e") != std::string::npos;
        text += (text.empty() ? "" : ", ") + (speaks ? value : with_greek(name) + " = " + value);
    };
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool shared =
            std::all_of(keys.begin(), keys.end(), [&](const auto& key) { return key[i] == keys[0][i]; });
        if (shared && !keys.empty() && i < selection.by.size()) append(plot.title, names[i], keys[0][i]);
        for (std::size_t k = 0; k < keys.size() && !shared; ++k) append(series[k].label, names[i], keys[k][i]);
    }
    if (series.size() == 1) series[0].label = plot.y_label;
    plot.series.insert(plot.series.end(), series.begin(), series.end());
}

bool plot_is_png(const Options& options) {
    const std::string path = options.text("plot");
    const std::string ending = std::filesystem::path(path).extension().string();
    if (ending != ".svg" && ending != ".png") throw BadInput(options.said("plot") + " must end in .svg or .png");
    return ending == ".png";
}

void draw(const Plot& plot, OutputFile& file, bool png) {
    const std::string picture = run_gnuplot(gnuplot_script(plot, png), file.path());
    if (!is_whole(picture, png)) {
        throw PlotError("--plot = " + file.path() + ": gnuplot drew " + (picture.empty() ? "nothing" : "only a part") +
                        "; the rows are written");
    }
    file.write(picture);
    file.commit();
}

}  // namespace study
