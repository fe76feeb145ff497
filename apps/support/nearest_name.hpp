// The name that was probably meant where one is mistyped.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace study {

/// How many letters to add, remove or change to turn `from` into `to`, regardless of case.
inline std::size_t edit_distance(const std::string& from, const std::string& to) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    std::vector<std::size_t> before(to.size() + 1), row(to.size() + 1);
    for (std::size_t k = 0; k <= to.size(); ++k) before[k] = k;
    for (std::size_t i = 0; i < from.size(); ++i) {
        row[0] = i + 1;
        for (std::size_t k = 0; k < to.size(); ++k) {
            const std::size_t changed = before[k] + (lower(from[i]) == lower(to[k]) ? 0 : 1);
            row[k + 1] = std::min({changed, before[k + 1] + 1, row[k] + 1});
        }
        std::swap(before, row);
    }
    return before.back();
}

/// The letters and digits of `name` in lower case.
inline std::string plain(const std::string& name) {
    std::string result;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0) result += static_cast<char>(std::tolower(byte));
    }
    return result;
}

/// The nearest of `names`: one that differs in case, hyphens and underscores only, or by the fewest letters, or the
/// first that begins with `word`; empty if none is near.
inline std::string nearest_name(const std::string& word, const std::vector<std::string>& names) {
    const auto same = [&](const std::string& name) { return plain(name) == plain(word); };
    const auto spelled = std::find_if(names.begin(), names.end(), same);
    if (spelled != names.end() && !plain(word).empty()) return *spelled;
    std::string nearest;
    std::size_t least = word.size() < 4 ? 2 : 3;  // fewer changes than that are near
    for (const std::string& name : names) {
        const std::size_t distance = edit_distance(word, name);
        if (distance >= least || distance >= name.size()) continue;
        least = distance;
        nearest = name;
    }
    if (!nearest.empty() || word.size() < 3) return nearest;
    const auto begins = [&](const std::string& name) { return name.rfind(word, 0) == 0; };
    const auto found = std::find_if(names.begin(), names.end(), begins);
    return found == names.end() ? "" : *found;
}

}  // namespace study
