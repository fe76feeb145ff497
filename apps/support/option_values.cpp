// The values that are read from options, with their rules and messages, and what a mistyped name may mean.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <utility>

#include "input.hpp"
#include "options.hpp"

namespace study {

namespace {

void require_digits(const std::string& name, const std::string& text, double value, bool may_be_0 = true) {
    if (value == 0 || !(std::abs(value) < rollbem::detail::least_number)) return;
    throw BadInput("--" + name + " = " + text + " must be " + (may_be_0 ? "0 or " : "") +
                   "at least 1e-100 in size: products of smaller numbers lose digits");
}

// `what` is expected: "a number" of a list, or "one number".
double to_number(const std::string& name, const std::string& text, const std::string& what, const Rule& rule) {
    const std::optional<double> value = detail::parse_number<double>(text);
    if (!value) throw BadInput("--" + name + " = " + text + " must be " + what + ", and it must " + rule.text);
    if (!rule.holds(*value)) throw BadInput("--" + name + " = " + text + " must " + rule.text);
    require_digits(name, text, *value, rule.holds(0));
    return *value;
}

std::ptrdiff_t to_integer(const std::string& name, const std::string& text, std::ptrdiff_t low, std::ptrdiff_t high) {
    const std::optional<std::ptrdiff_t> value = detail::parse_number<std::ptrdiff_t>(text);
    if (!value || *value < low || *value > high) {
        throw BadInput("--" + name + " = " + text + " must be an integer in [" + std::to_string(low) + ", " +
                       std::to_string(high) + "]");
    }
    return *value;
}

}  // namespace

namespace detail {

std::size_t edit_distance(const std::string& from, const std::string& to) {
    std::vector<std::size_t> row(to.size() + 1);
    for (std::size_t k = 0; k <= to.size(); ++k) row[k] = k;
    for (std::size_t i = 0; i < from.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t k = 0; k < to.size(); ++k) {
            const std::size_t changed = diagonal + (from[i] == to[k] ? 0 : 1);
            diagonal = row[k + 1];
            row[k + 1] = std::min({changed, diagonal + 1, row[k] + 1});
        }
    }
    return row.back();
}

}  // namespace detail

bool contains(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

Rule between(double low, double high) {
    std::ostringstream text;
    text.precision(12);
    text << "lie in [" << low << ", " << high << "]";
    return {[=](double value) { return value >= low && value <= high; }, text.str()};
}

Rule in_unit(const std::string& unit, double low, double high) {
    std::ostringstream text;
    text << "be in " << unit << ", " << low << " to " << high;
    return {between(low, high).holds, text.str()};
}

Rule shear_modulus() { return in_unit("Pa", 1e7, 1e13); }

Rule finite() {
    return {[](double value) { return std::isfinite(value); }, "be finite"};
}

Rule positive() {
    return {[](double value) { return value > 0 && std::isfinite(value); }, "be positive and finite"};
}

Rule not_negative() {
    return {[](double value) { return value >= 0 && std::isfinite(value); }, "be finite and not negative"};
}

Rule positive_or_infinite() {
    return {[](double value) { return value > 0; }, "be positive (inf is allowed)"};
}

std::string wrap(const std::string& text, std::size_t width) {
    std::istringstream words(text);
    std::string word, result;
    std::size_t column = 0;
    while (words >> word) {
        if (column > 0) {
            const bool breaks = column + 1 + word.size() > width;
            result += breaks ? '\n' : ' ';
            column = breaks ? 0 : column + 1;
        }
        result += word;
        column += word.size();
    }
    return result;
}

std::string join(const std::vector<std::string>& words, const std::string& separator) {
    std::string result;
    for (const std::string& word : words) result += (&word == words.data() ? "" : separator) + word;
    return result;
}

std::string listed(const std::vector<std::string>& words, const std::string& last) {
    if (words.size() < 2) return join(words, "");
    return join({words.begin(), words.end() - 1}, ", ") + " " + last + " " + words.back();
}
bool Options::given(const std::string& name) const { return entry(name).typed() || !entry(name).configured.empty(); }

std::string Options::said(const std::string& name) const {
    const std::string value = join(raw(name), ",");
    return "--" + name + " = " + (value.empty() ? "''" : value);
}

void Options::ignored(const std::string& name, const std::string& reason) const {
    if (given(name)) throw BadInput(said(name) + " has no effect " + reason);
}

bool Options::flag(const std::string& name) const {
    if (!given(name)) return false;
    const std::string value = raw(name).back();
    if (value != "true" && value != "false") throw BadInput("--" + name + " = " + value + " must be true or false");
    return value == "true";
}

std::string Options::text(const std::string& name) const {
    const std::vector<std::string> values = raw(name);
    if (values.size() > 1) throw BadInput(said(name) + " must be a single value");
    if (given(name) && values.front().empty()) throw BadInput(said(name) + " must not be empty");
    return values.empty() ? std::string() : values.front();
}

std::string Options::choice(const std::string& name, const std::vector<std::string>& names) const {
    const std::string value = text(name);
    if (!contains(names, value)) throw BadInput(said(name) + " must be one of " + join(names, ", "));
    return value;
}

double Options::number(const std::string& name, const Rule& rule) const {
    return to_number(name, text(name), "one number", rule);
}

std::vector<double> Options::row(const std::string& name, std::size_t count) const {
    const std::vector<std::string> parts = cells_of(text(name));
    std::vector<double> found;
    for (const std::string& part : parts) {
        const auto number = detail::parse_number<double>(part);
        if (parts.size() != count || !number || !std::isfinite(*number)) return {};
        require_digits(name, text(name), *number);
        found.push_back(*number);
    }
    return found;
}

std::optional<std::pair<double, double>> Options::pair(const std::string& name) const {
    const std::vector<double> both = row(name, 2);
    if (both.empty()) return std::nullopt;
    return std::pair(both[0], both[1]);
}

std::ptrdiff_t Options::integer(const std::string& name, std::ptrdiff_t low, std::ptrdiff_t high) const {
    return to_integer(name, text(name), low, high);
}

template <class Number, class Read>
std::vector<Number> Options::list(const std::string& name, const Read& read) const {
    std::vector<Number> result;
    if (raw(name).empty()) return result;
    for (const std::string& item : cells_of(join(raw(name), ","))) {
        if (item.empty()) throw BadInput(said(name) + " must be a list without empty items");
        const Number value = read(item);
        require(std::find(result.begin(), result.end(), value) == result.end(), name,
                "be a list without repeated items: " + item + " is there twice");
        result.push_back(value);
    }
    return result;
}

std::vector<double> Options::numbers(const std::string& name, const Rule& rule) const {
    return list<double>(name, [&](const std::string& item) { return to_number(name, item, "a number", rule); });
}

std::vector<std::ptrdiff_t> Options::integers(const std::string& name, std::ptrdiff_t low, std::ptrdiff_t high) const {
    return list<std::ptrdiff_t>(name, [&](const std::string& item) { return to_integer(name, item, low, high); });
}

std::vector<std::string> Options::choices(const std::string& name, const std::vector<std::string>& known) const {
    const std::vector<std::string> given = list<std::string>(name, [&](const std::string& item) {
        if (item == "all" || contains(known, item)) return item;
        throw BadInput("--" + name + " = " + item + " must be all, or some of " + join(known, ","));
    });
    std::vector<std::string> result;
    for (const std::string& word : known) {
        if (contains(given, "all") || contains(given, word)) result.push_back(word);
    }
    return result;
}

std::vector<std::string> Options::texts(const std::string& name) const {
    return list<std::string>(name, [](const std::string& item) { return item; });
}

std::string Options::suggestion(const std::string& word) const {
    const auto letters = [](std::string name) {  // and digits
        const auto is_other = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; };
        name.erase(std::remove_if(name.begin(), name.end(), is_other), name.end());
        for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return name;
    };
    const std::string meant = word.substr(std::min(word.find_first_not_of('-'), word.size())), plain = letters(word);
    std::vector<std::string> names{"help", "version"};
    for (const auto& [name, entry] : entries_) {
        if (entry.refusal.empty()) names.push_back(name);
    }
    std::string nearest, begun;
    std::size_t least = meant.size() < 4 ? 2 : 3;  // fewer changes than that are near
    for (const std::string& name : names) {
        if (begun.empty() && plain.size() > 2 && letters(name).rfind(plain, 0) == 0) begun = name;
        const std::size_t distance = letters(name) == plain ? 0 : detail::edit_distance(meant, name);
        if (distance >= least || distance >= name.size()) continue;
        least = distance;
        nearest = name;
    }
    if (nearest.empty()) nearest = begun;
    return nearest.empty() ? "" : "; did you mean --" + nearest + "?";
}

}  // namespace study
