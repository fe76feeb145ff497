// apps/support, apps/friction: any command line or file is either accepted or rejected by std::invalid_argument in one
// line. The first byte of an input gives its kind: c command line (one word per line), t configuration file, e edges,
// h history, p pressure, f command line of a varying load, l and b its table on a fixed or a breathing mesh.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

#include <rollbem/normal/hertz.hpp>

#include "friction/steady.hpp"
#include "support/input.hpp"
#include "support/options.hpp"
#include "support/runs.hpp"
#include "support/scenes.hpp"
#include "support/sidecar.hpp"

namespace {

/// A file with the given content, under a name that can be opened.
class MemoryFile {
public:
    explicit MemoryFile(std::string_view content) : descriptor_(memfd_create("input", 0)) {
        if (descriptor_ < 0 || write(descriptor_, content.data(), content.size()) != ssize_t(content.size())) {
            std::perror("memory file");
            std::exit(1);
        }
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { close(descriptor_); }

    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

private:
    int descriptor_;
};

void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "broken: %s\n", what);
    std::abort();
}

/// Reads the words as a study would. Only std::invalid_argument escapes.
void take(const std::vector<std::string>& words) {
    study::Options options("fuzz", "purpose");
    const study::HistoryColumns columns{{"creepage"}};
    study::add_run_options(options, columns);
    options.add("omega", "LIST", "numbers");
    options.refuse("plot", "there is nothing to draw");
    std::vector<const char*> argv{"fuzz"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    if (options.parse(static_cast<int>(argv.size()), argv.data())) return;
    if (options.given("omega")) options.numbers("omega", study::positive());
    if (options.given("history")) {
        const study::History history = study::read_run(options, columns).imposed;
        const study::Numbers& places = history.places();
        require(!places.empty() && places.size() == history.values("creepage").size(), "as many places as values");
        require(std::is_sorted(places.begin(), places.end()), "places ascend");
    }
    for (const study::Scene& scene : study::make_scenes(options, study::Problem::steady, {})) {
        require(scene.n() >= 1 && (scene.mesh->widths() > 0).all(), "every element has a width");
    }
    const std::string sidecar = study::sidecar_text(options);
    require(sidecar.find('\0') == std::string::npos, "a text has no zero bytes");
}

/// Reads the words as friction_study does in the time domain, up to the load of every step.
void take_friction(const std::vector<std::string>& words) {
    study::Options options("fuzz", "purpose");
    options.add_input("pressure", "a file");
    options.add("lateral-ratio", "LIST", "numbers");
    options.add("layer", "L", "a number", "0");
    options.add("creepage-ratio", "LIST", "numbers");
    study::add_run_options(options, friction::history_columns);
    std::vector<const char*> argv{"fuzz"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    if (options.parse(static_cast<int>(argv.size()), argv.data())) return;
    if (options.given("lateral-ratio")) options.numbers("lateral-ratio", study::finite());
    options.number("layer", study::finite());
    const rollbem::Mesh<double> mesh = rollbem::cosine_mesh(5);
    const friction::Pressure pressure = friction::read_pressure(options);
    require((pressure(mesh) >= 0).all() && pressure(mesh).allFinite(), "pressures press");
    const study::Run run = study::read_run(options, friction::history_columns);
    if (!run.load_varies()) return;
    const rollbem::HertzLine::Load hertz = friction::hertz_load(run, mesh);
    rollbem::NormalLoad load = hertz.at(friction::mu_N);
    const double stride = std::max(run.steps.dq, run.until() / 50);
    for (double q = 0; q < run.until(); q += stride) {
        const double end = std::min(run.until(), q + stride);
        study::roll(q, end, run.imposed.places(), [&](double from, double to) {
            require(from < to && to <= end, "steps go on");
            const double ratio = run.load_ratio(from);
            require(std::isfinite(ratio) && ratio >= 0, "a load presses");
            const rollbem::Status status = hertz.set(ratio * friction::mu_N, load);
            // an underflowing load has no contact length
            require(status == rollbem::Status::ok || (run.breathing && ratio < 1e-290), "the mesh covers every load");
            return rollbem::Status::ok;
        });
    }
}

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines{""};
    for (const char c : text) {
        if (c == '\n') {
            lines.emplace_back();
        } else if (c != '\0') {
            lines.back() += c;
        }
    }
    return lines;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view input(reinterpret_cast<const char*>(data), size);
    if (input.empty()) return 0;
    const std::string_view content = input.substr(1);
    const MemoryFile file(content);
    try {
        switch (input[0]) {
            case 'c':
            case 'f':
                // files are inputs of the other kinds, and huge numbers of elements would take too long
                if (content.find('/') != std::string_view::npos || content.find("0000") != std::string_view::npos)
                    break;
                (input[0] == 'c' ? take : take_friction)(lines_of(content));
                break;
            case 'p': take_friction({"--pressure", file.path()}); break;
            case 'l': take_friction({"--load", file.path(), "--until", "4"}); break;
            case 'b': take_friction({"--load", file.path(), "--until", "4", "--kernel", "plane", "--breathing"}); break;
            case 't': take({"--config", file.path()}); break;
            case 'e': take({"--edges", file.path(), "--alpha", "0.5"}); break;
            case 'h': take({"--history", file.path(), "--n", "3"}); break;
            default: break;
        }
    } catch (const std::invalid_argument& refusal) {
        require(refusal.what()[0] != '\0', "a refusal says why");
    }
    return 0;
}
