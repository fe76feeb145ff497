#include "config_file.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <optional>

#include "errors.hpp"
#include "files.hpp"
#include "options.hpp"

namespace study {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

bool is_control(char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F; }

/// A code point as UTF-8, or nothing where there is none.
std::optional<std::string> utf8(std::uint32_t code) {
    if (code == 0 || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return std::nullopt;
    const auto byte = [](std::uint32_t value) { return static_cast<char>(static_cast<unsigned char>(value)); };
    const auto next = [&](unsigned shift) { return byte(0x80 | ((code >> shift) & 0x3F)); };
    if (code < 0x80) return std::string{byte(code)};
    if (code < 0x800) return std::string{byte(0xC0 | (code >> 6)), next(0)};
    if (code < 0x10000) return std::string{byte(0xE0 | (code >> 12)), next(6), next(0)};
    return std::string{byte(0xF0 | (code >> 18)), next(12), next(6), next(0)};
}

class Reader {
public:
    Reader(std::string_view text, const std::string& said)
        : text_(text), said_(said), has_sections_(is_sidecar(text)) {}

    std::vector<Setting> read() {
        std::vector<Setting> settings;
        while (true) {
            skip_blanks();
            if (at_end()) return settings;
            line_ = Line{here_, number_};
            if (peek() == '#' || peek() == ';') skip_line();
            if (peek() == '[' && has_sections_) read_section();
            if (!at_end() && peek() != '\n') settings.push_back(setting(settings));
            if (!at_end()) advance();
        }
    }

private:
    struct Line {
        std::size_t begin = 0, number = 1;
    };

    bool at_end() const { return here_ >= text_.size(); }
    char peek() const { return at_end() ? '\n' : text_[here_]; }
    void advance() {
        if (text_[here_++] == '\n') ++number_;
    }
    void skip_blanks() {
        while (!at_end() && is_blank(peek())) advance();
    }
    void skip_line() {
        while (!at_end() && peek() != '\n') advance();
    }

    /// "--config = file: line 3 = text"; of a list, the line where it begins.
    std::string where() const {
        const std::size_t end = std::min(text_.find('\n', line_.begin), text_.size());
        const std::string line = printable(detail::trim(text_.substr(line_.begin, end - line_.begin)));
        return said_ + ": line " + std::to_string(line_.number) + " = " + line;
    }

    [[noreturn]] void fail(const std::string& rule) const { throw BadInput(where() + " must " + rule); }

    void read_section() {
        advance();
        section_ = name();
        if (peek() != ']') fail("be [NAME]");
        advance();
        skip_blanks();
        if (peek() == '#') skip_line();
        if (peek() != '\n') fail("end after its ]");
    }

    Setting setting(const std::vector<Setting>& before) {
        if (peek() == '[') fail("be NAME = VALUE: there are no sections");
        Setting result{name(), {}, where(), section_};
        skip_blanks();
        if (peek() != '=') fail("be NAME = VALUE");
        advance();
        skip_blanks();
        result.values = peek() == '[' ? list() : std::vector<std::string>{is_quote() ? quoted() : bare()};
        skip_blanks();
        if (peek() == '#') skip_line();
        if (peek() != '\n') fail("end after its value");
        for (const Setting& other : before) {
            if (other.name == result.name && other.section == section_)
                fail("not give " + result.name + " a second time");
        }
        return result;
    }

    std::string name() {
        if (is_quote()) return quoted();
        std::string result;
        while (std::isalnum(static_cast<unsigned char>(peek())) != 0 || peek() == '-' || peek() == '_') {
            result += peek();
            advance();
        }
        if (result.empty()) fail("be NAME = VALUE");
        return result;
    }

    bool is_quote() const { return peek() == '"' || peek() == '\''; }

    std::string quoted() {
        const char quote = peek();
        advance();
        std::string result;
        while (peek() != quote) {
            if (peek() == '\n') fail("close its quotes");
            if (is_control(peek())) fail("not have control characters");
            if (quote == '"' && peek() == '\\') {
                result += escape();
            } else {
                result += peek();
                advance();
            }
        }
        advance();
        return result;
    }

    std::string escape() {
        advance();
        const char kind = peek();
        constexpr std::string_view letters = "btnfr\"\\", meanings = "\b\t\n\f\r\"\\";
        const std::size_t letter = letters.find(kind);
        if (letter != std::string_view::npos) {
            advance();
            return {meanings[letter]};
        }
        const std::size_t digits = kind == 'u' ? 4 : kind == 'U' ? 8 : 0;
        const std::string_view number = text_.substr(std::min(here_ + 1, text_.size()), digits);
        std::uint32_t code = 0;
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), code, 16);
        const bool is_number =
            digits > 0 && number.size() == digits && error == std::errc{} && end == number.data() + digits;
        const std::optional<std::string> character = is_number ? utf8(code) : std::nullopt;
        if (!character) fail("not have an escape that TOML does not know");
        here_ += 1 + digits;
        return *character;
    }

    /// Words up to the end of the line, with blanks beside commas only.
    std::string bare() {
        const std::size_t begin = here_;
        while (peek() != '\n' && peek() != '#') advance();
        const std::string_view value = detail::trim(text_.substr(begin, here_ - begin));
        if (value.empty()) fail("have a value");
        for (std::size_t i = 0; i < value.size(); ++i) {
            const bool beside_comma = is_blank(value[i]) && (value[value.find_last_not_of(" \t\r", i)] == ',' ||
                                                             value[value.find_first_not_of(" \t\r", i)] == ',');
            const bool allowed = std::string_view("\"'[]{}= \t\r").find(value[i]) == std::string_view::npos;
            if (!(allowed || beside_comma) || is_control(value[i])) {
                fail("have quotes around a value with blanks, quotes, brackets or =");
            }
        }
        return std::string(value);
    }

    std::vector<std::string> list() {
        const auto skip = [&] {
            while (!at_end() && (is_blank(peek()) || peek() == '\n' || peek() == '#')) {
                peek() == '#' ? skip_line() : advance();
            }
        };
        std::vector<std::string> items;
        advance();
        while (true) {
            skip();
            if (peek() == ']' && !items.empty()) break;  // a comma before it is TOML
            items.push_back(is_quote() ? quoted() : word());
            skip();
            if (peek() == ']') break;
            if (peek() != ',') fail_list();
            advance();
        }
        advance();
        return items;
    }

    /// A word of a list.
    std::string word() {
        std::string result;
        while (!is_blank(peek()) && std::string_view(",[]{}\"'=#\n").find(peek()) == std::string_view::npos) {
            if (is_control(peek())) fail("not have control characters");
            result += peek();
            advance();
        }
        if (result.empty()) fail_list();
        return result;
    }

    [[noreturn]] void fail_list() const { fail("be a list [VALUE, VALUE], with its ] at the end"); }

    std::string_view text_;
    std::string said_, section_{};
    bool has_sections_;
    std::size_t here_ = 0, number_ = 1;
    Line line_;  // of the setting
};

}  // namespace

bool is_sidecar(std::string_view text) {
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        if (detail::trim(text.substr(begin, end - begin)) == "[given]") return true;
        begin = end + 1;
    }
    return false;
}

std::vector<Setting> read_settings(std::string_view text, const std::string& said) { return Reader(text, said).read(); }

}  // namespace study
