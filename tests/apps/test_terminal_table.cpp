// apps/support/terminal_table.hpp
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/terminal_table.hpp"

namespace terminal_table_tests {
namespace {

using study::Cell;
using study::Heading;
using study::Row;
using study::TerminalTable;

constexpr std::size_t wide = 1000;

std::string shown(const std::vector<Heading>& headings, const std::vector<Row>& rows, std::size_t width = wide,
                  bool by_scheme = false) {
    TerminalTable table(headings, by_scheme);
    for (const Row& row : rows) table.add(row);
    return table.text(width);
}

TEST_CASE("A table has what the case varies and its results, points below one another, 6 digits", "[terminal]") {
    const std::vector<Heading> headings{{"mesh", "", true},    {"n", "", true}, {"force", "[N]"},
                                        {"residual", "[m^2]"}, {"never"},       {"status"}};
    CHECK(shown(headings, {{"cosine", 8, 12345.678901, 1e-16, Cell(), "ok"},
                           {"cosine", 16, -1.5, 0.25, Cell(), "not_converged"},
                           {"cosine", 160, Cell(), 2, Cell(), "ok"}}) ==
          "  n    force  residual  status\n"
          "         [N]     [m^2]\n"
          "  8  12345.7     1e-16  ok\n"
          " 16     -1.5     0.25   not_converged\n"
          "160              2      ok\n"
          "2 more columns in CSV: --output FILE\n");
}

TEST_CASE("A table without anything left out has no last line, and without units one line of names", "[terminal]") {
    CHECK(shown({{"n", "", true}, {"c"}}, {{1, 0.5}, {2, 10.25}}) == "n      c\n1   0.5\n2  10.25\n");
}

TEST_CASE("At most forty rows are shown, and the others counted; all of them decide what varies", "[terminal]") {
    for (const int count : {40, 41, 500}) {
        std::vector<Row> rows;
        for (int i = 0; i < count; ++i) rows.push_back({i < 40 ? "early" : "late", i});
        const std::string text = shown({{"part", "", true}, {"value"}}, rows);
        CAPTURE(count, text);
        CHECK(std::count(text.begin(), text.end(), '\n') == 42);
        CHECK((text.find("early") != std::string::npos) == (count > 40));
        const std::string last = text.substr(text.rfind('\n', text.size() - 2) + 1);
        CHECK(last == (count == 40   ? "1 more column in CSV: --output FILE\n"
                       : count == 41 ? "1 more row in CSV: --output FILE\n"
                                     : "460 more rows in CSV: --output FILE\n"));
    }
}

TEST_CASE("On a narrow terminal times are left out first, then results from the right, never what varies or the status",
          "[terminal]") {
    const std::vector<Heading> headings{{"n", "", true}, {"first"}, {"run_us"}, {"second"}, {"status"}};
    const std::vector<Row> rows{{1, 0.5, 3.5, 0.25, "ok"}, {2, 0.5, 3.5, 0.25, "ok"}};
    const auto head = [&](std::size_t width) {
        const std::string text = shown(headings, rows, width);
        return text.substr(0, text.find('\n'));
    };
    CHECK(head(32) == "n  first  run_us  second  status");
    CHECK(head(31) == "n  first  second  status");
    CHECK(head(24) == "n  first  second  status");
    CHECK(head(23) == "n  first  status");
    CHECK(head(1) == "n  first  status");
}

TEST_CASE("On a narrow terminal a long text is cut, and a verdict stays", "[terminal]") {
    const std::vector<Heading> headings{{"case"}, {"value"}, {"verdict"}, {"told"}, {"status"}};
    const std::string name(70, 'x'), told(200, 'y');
    const std::string text = shown(headings, {{name, 0.5, "told", told, "not_converged"}}, 60);
    CHECK(text.substr(0, text.find("\nx")) == "case" + std::string(34, ' ') + "verdict  status");
    CHECK(text.find("\n" + std::string(33, 'x') + "...  told     not_converged\n") != std::string::npos);
}

TEST_CASE("A list of schemes is told by their words alone, other lists by the columns that vary", "[terminal]") {
    const std::vector<Heading> headings{
        {"mesh", "", true}, {"n", "", true}, {"alpha_T", "", true}, {"c11"}, {"scheme", "", true}};
    const std::vector<Row> rows{{"uniform", 8, 0.5, 2, "uniform:0.5"},
                                {"cosine", 8, 0.6, 2, "cosine:0.6"},
                                {"uniform", 16, 0.5, 2, "uniform:0.5"}};
    const auto head = [&](bool by_scheme) {
        const std::string text = shown(headings, rows, wide, by_scheme);
        return text.substr(0, text.find('\n'));
    };
    CHECK(head(true) == " n  c11  scheme");
    CHECK(head(false) == "mesh      n  alpha_T  c11");
}

TEST_CASE("Blocks have a quantity a line, in millimetres and megapascals, without what is not known", "[terminal]") {
    TerminalTable table({{"shift", "[m]", true},
                         {"side"},
                         {"load", "[N]"},
                         {"peak_pressure", "[Pa]"},
                         {"area", "[m^2]"},
                         {"spin", "[1/m]"},
                         {"other"},
                         {"status"}},
                        false);
    table.add({0.0025, "left", 8e4, 1.4112345e9, 9.5e-5, Cell(), 1, "ok"});
    table.add({0.0025, "right", Cell(), Cell(), Cell(), Cell(), 1, "no_contact"});
    CHECK(table.text({{"shift", "side", "status"}, {"load", "peak_pressure", "area", "spin", "absent"}}) ==
          "shift 2.5 mm, side left, status ok\n"
          "  load           80000 N\n"
          "  peak_pressure  1411.23 MPa\n"
          "  area           95 mm^2\n"
          "shift 2.5 mm, side right, status no_contact\n"
          "1 more column in CSV: --output FILE\n");
}

TEST_CASE("The unit of a column stands in its meaning or beside its name", "[terminal]") {
    CHECK(study::unit_in("angle [rad]: turned; depth [m]") == "[rad]");
    CHECK(study::unit_in("time of all [microseconds], of one run") == "");
    CHECK(study::unit_in("c11_ratio - 1") == "");
    CHECK(study::unit_in("open [") == "");
    CHECK(study::heading_of("yaw [rad]").name == "yaw");
    CHECK(study::heading_of("yaw [rad]").unit == "[rad]");
    CHECK(study::heading_of("n").unit == "");
}

}  // namespace
}  // namespace terminal_table_tests
