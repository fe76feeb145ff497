// apps/support/csv.hpp
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/options.hpp"
#include "support/sidecar.hpp"

namespace csv_tests {
namespace {

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

study::Options parsed(const std::vector<std::string>& words) {
    study::Options options("study", "purpose");
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    REQUIRE_FALSE(options.parse(static_cast<int>(argv.size()), argv.data()).has_value());
    return options;
}

TEST_CASE("A shell recovers the command line from a sidecar, and --config its options", "[csv]") {
    const char* const file = "test_csv_sidecar.toml";
    for (const std::string name : {"plain", "it's", "two words \"quoted\" $HOME `id` *?[a] ~ #no !x;&|<>(),",
                                   "Grüße, δ", "tab\tx", "# no comment", "a=b", "[given", "true"}) {
        const std::vector<std::string> words{"study",   "--edges", name,       "--poisson",
                                             "0.1,0.2", "--quiet", "--output", "x"};
        const std::string sidecar = study::sidecar_text(parsed(words));
        CAPTURE(sidecar);
        const std::string start = "\n# command_line = ";
        const std::size_t line = sidecar.find(start) + start.size();
        if (name != "tab\tx") CHECK(shell_words(sidecar.substr(line, sidecar.find('\n', line) - line)) == words);
        std::ofstream(file) << sidecar;
        const study::Options again = parsed({"study", "--config", file});
        CHECK(again.text("edges") == name);
        CHECK(again.text("poisson") == "0.1,0.2");
        CHECK(again.flag("quiet"));
        CHECK_FALSE(again.given("output"));
    }
    std::remove(file);
    for (const char* const name : {"it's \"both\"", "line\nend", "a\\z"}) {
        CHECK_THROWS_AS(study::sidecar_text(parsed({"study", "--edges", name})), study::BadInput);
    }
}

TEST_CASE("Records find cells by the names of columns", "[csv]") {
    const study::Records records{{"n", "status", "error"}, {{20, "ok", 1e-3}, {10, "coarse", {}}, {20, "ok", 2e-3}}};
    CHECK(records.number(records.rows[2], "error") == 2e-3);
    CHECK(std::isnan(records.number(records.rows[1], "error")));
    CHECK(std::isnan(records.number(records.rows[1], "status")));
    CHECK(records.cell(records.rows[1], "status").text() == "coarse");
    CHECK(records.numbers("n") == std::set<double>{10, 20});
    CHECK(records.numbers("error").size() == 2);
    CHECK(records.texts("status") == std::set<std::string>{"coarse", "ok"});
    const study::Records coarse = records.with("n", "10"), ok = records.with("status", "ok");
    CHECK(coarse.rows.size() + ok.rows.size() == records.rows.size());
    CHECK(ok.columns == records.columns);
    CHECK(ok.number(ok.rows[1], "error") == 2e-3);
    CHECK_THROWS_AS(records.cell(records.rows[0], "nothing"), std::out_of_range);
}

}  // namespace
}  // namespace csv_tests
