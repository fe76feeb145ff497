#include "config_file.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace study {

namespace {

using rollbem::detail::trimmed;

/// The text with x for what stands in quotes; quotes open at its beginning or behind one of " ,[" and need not close.
std::string masked(std::string text) {
    char open = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (open != 0) {
            text[i] = 'x';
            if (c == open) open = 0;
        } else if ((c == '"' || c == '\'') && (i == 0 || std::string_view(" \t,[").find(text[i - 1]) < 4)) {
            open = c;
        }
    }
    return text;
}

/// The text up to a # outside quotes.
std::string uncommented(const std::string& text) { return text.substr(0, masked(text).find('#')); }

/// The text without quotes at both ends.
std::string unquoted(std::string_view text) {
    text = trimmed(text);
    if (text.size() > 1 && (text[0] == '"' || text[0] == '\'') && text.back() == text[0]) {
        text = text.substr(1, text.size() - 2);
    }
    return std::string(trimmed(text));
}

/// The items of a text between commas, or between blanks where it has none.
std::vector<std::string> items(const std::string& text) {
    const std::string plain = masked(text);
    const char* const separators = plain.find(',') == std::string::npos ? " \t" : ",";
    std::vector<std::string> found;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t end = std::min(plain.find_first_of(separators, from), text.size());
        if (*separators == ',' || end > from) found.push_back(unquoted(text.substr(from, end - from)));
        from = end + 1;
    }
    return found;
}

}  // namespace

std::vector<Setting> read_settings(Lines lines) {
    std::vector<Setting> settings;
    while (lines.next()) {
        const std::string line = lines.text();
        if (line[0] == ';') continue;
        Setting setting{"", lines.where(), {}};
        const auto require = [&](bool holds, const std::string& what) {
            if (!holds) throw BadInput(setting.where + " = " + line + " must " + what);
        };
        require(line[0] != '[', "not be there: a configuration file has no sections");
        const std::size_t equals = line.find('=');
        setting.name = unquoted(line.substr(0, equals));
        std::string value(equals == std::string::npos ? "" : trimmed(line.substr(equals + 1)));
        require(equals == std::string::npos || !value.empty(), "have a value");
        if (value.rfind('[', 0) == 0) {
            std::size_t end;
            value = uncommented(value);
            while ((end = masked(value).find(']')) == std::string::npos) {
                if (!lines.next()) throw BadInput(setting.where + ": each [ must have its ]");
                value += ' ' + uncommented(lines.text());
            }
            require(trimmed(std::string_view(value).substr(end + 1)).empty(), "end with its ]");
            setting.values = items(value.substr(1, end - 1));
            if (!setting.values.empty() && setting.values.back().empty()) setting.values.pop_back();
            require(!setting.values.empty(), "have a value");
        } else if (!value.empty()) {
            setting.values = items(value);
        }
        const std::string plain = masked(value);
        require(plain != value || !contains(setting.values, ""), "be a list without empty items");
        if (value.rfind('[', 0) != 0 && plain.find(',') != std::string::npos)
            setting.values = {join(setting.values, ",")};
        settings.push_back(std::move(setting));
    }
    return settings;
}

}  // namespace study
