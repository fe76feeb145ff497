// apps/support: whatever is typed or stands in a file is either taken or refused by std::invalid_argument in one line.
// The first byte of an input says what it is: c command line (a word a line), t configuration file, e edges, h history.
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

#include "support/csv.hpp"
#include "support/options.hpp"
#include "support/pairs_file.hpp"
#include "support/scenes.hpp"

namespace {

/// A file with given content, by a name that can be opened.
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

/// Reads the words as a study would. Only refusals by std::invalid_argument get out.
void take(const std::vector<std::string>& words) {
    study::Options options("fuzz", "purpose");
    options.add_input("history", "a file");
    options.add("omega", "LIST", "numbers");
    options.refuse("plot", "there is nothing to draw");
    std::vector<const char*> argv{"fuzz"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    if (options.parse(static_cast<int>(argv.size()), argv.data())) return;
    if (options.given("omega")) options.numbers("omega", study::positive());
    if (options.given("history")) {
        const study::Pairs pairs = study::read_pairs(options, "history", "q_over_a,creepage", study::between(0, 1e9));
        require(!pairs.places.empty() && pairs.places.size() == pairs.values.size(), "as many places as values");
        for (std::size_t k = 1; k < pairs.places.size(); ++k) {
            require(pairs.places[k] >= pairs.places[k - 1], "places ascend");
        }
    }
    for (const study::Scene& scene : study::make_scenes(options, study::Problem::steady)) {
        require(scene.n() >= 1 && (scene.mesh->widths() > 0).all(), "every element has a width");
    }
    const std::string sidecar = study::sidecar_text(options);
    require(sidecar.find('\0') == std::string::npos, "TOML has no zero bytes");
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
                // no files but those of the other kinds, and not a hundred thousand elements a thousand times
                if (content.find('/') != std::string_view::npos || content.find("0000") != std::string_view::npos)
                    break;
                take(lines_of(content));
                break;
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
