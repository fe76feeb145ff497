// apps/support/csv.hpp
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/options.hpp"
#include "support/sidecar.hpp"

namespace csv_tests {
namespace {

/// The value of a line `key = "basic string"`. Knows only the escapes that a program needs, and throws on whatever
/// TOML forbids.
std::string toml_value(const std::string& text, const std::string& key) {
    const std::string start = "\n" + key + " = \"";
    std::size_t i = ("\n" + text).find(start);
    if (i == std::string::npos) throw std::runtime_error("no key " + key);
    std::string value;
    for (i += start.size() - 1; text.at(i) != '"'; ++i) {
        if (static_cast<unsigned char>(text[i]) < 0x20) throw std::runtime_error("control character in a string");
        if (text[i] != '\\') {
            value += text[i];
            continue;
        }
        const char escape = text.at(++i);
        if (escape == '"' || escape == '\\') {
            value += escape;
        } else if (escape == 't' || escape == 'n') {
            value += escape == 't' ? '\t' : '\n';
        } else if (escape == 'u') {
            const int code = std::stoi(text.substr(i + 1, 4), nullptr, 16);
            if (code > 0x7F) throw std::runtime_error("no ASCII");
            value += static_cast<char>(code);
            i += 4;
        } else {
            throw std::runtime_error("unknown escape");
        }
    }
    if (text.at(i + 1) != '\n') throw std::runtime_error("text after a string");
    return value;
}

/// The words of a command line as the shell splits it.
std::vector<std::string> shell_words(const std::string& line) {
    ::setenv("ROLLBEM_TEST_LINE", line.c_str(), 1);
    std::FILE* const pipe = ::popen(R"(eval "set -- $ROLLBEM_TEST_LINE"; printf '%s\0' "$@")", "r");
    REQUIRE(pipe != nullptr);
    std::vector<std::string> words(1);
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) {
        if (c == '\0') {
            words.emplace_back();
        } else {
            words.back() += static_cast<char>(c);
        }
    }
    CHECK(::pclose(pipe) == 0);
    words.pop_back();
    return words;
}

TEST_CASE("A cell with a comma, a quote or a line break is quoted, and its own quotes are doubled", "[csv]") {
    CHECK(study::csv_line({"plain", 2, 0.5, study::Cell(), "a'b c\\d"}) == "plain,2,0.5,,a'b c\\d\n");
    CHECK(study::csv_line({"a,b", 1}) == "\"a,b\",1\n");
    CHECK(study::csv_line({"say \"no\""}) == "\"say \"\"no\"\"\"\n");
    CHECK(study::csv_line({"\""}) == "\"\"\"\"\n");
    CHECK(study::csv_line({"two\nlines", "r\rr"}) == "\"two\nlines\",\"r\rr\"\n");
}

TEST_CASE("A number is the shortest text that is read back exactly, and zero has no sign", "[csv]") {
    CHECK(study::csv_line({0.55, -0.0, 1.0 / 3, 20.0, 1e300}) == "0.55,0,0.3333333333333333,20,1e+300\n");
    CHECK(study::Cell(-0.0f).text() == "0");
    CHECK(study::Cell(2.0 / 3).text(6) == "0.666667");
    for (const double number : {0.1 + 0.2, 5e-324, 1.7976931348623157e308, -1e-5, 123456789.0}) {
        CHECK(std::strtod(study::Cell(number).text().c_str(), nullptr) == number);
    }
}

TEST_CASE("A TOML reader and a shell recover the command line from a sidecar", "[csv]") {
    const std::vector<std::vector<std::string>> lines{
        {"study", "--output", "plain.csv", "--n", "10,20"},
        {"study", "--output", "a\\z.csv"},
        {"study", "--output", "it's.csv"},
        {"study", "--output", "'", "--plot", "''\\''.svg"},
        {"study", "--output", "two words \"quoted\" $HOME `id` *?[a] ~ #no !x;&|<>().csv"},
        {"study", "--output", "tab\tline\nend"},
        {"study", "--output", "Grüße, δ.csv"},
    };
    for (const std::vector<std::string>& words : lines) {
        study::Options options("study", "purpose");
        std::vector<const char*> argv;
        for (const std::string& word : words) argv.push_back(word.c_str());
        REQUIRE_FALSE(options.parse(static_cast<int>(argv.size()), argv.data()).has_value());
        const std::string sidecar = study::sidecar_text(options);
        CAPTURE(sidecar);
        CHECK(shell_words(toml_value(sidecar, "command_line")) == words);
        CHECK(toml_value(sidecar, "output") == words[2]);
    }
}

}  // namespace
}  // namespace csv_tests
