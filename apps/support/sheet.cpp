#include "sheet.hpp"

#include <algorithm>
#include <set>

namespace study {

std::string help_line(const std::string& name, const std::string& meaning) {
    constexpr std::size_t indent = 20;
    const std::string margin(indent, ' ');
    std::string start = "  " + name, text;
    if (start.size() >= indent) start += '\n';
    start.append(start.size() < indent ? indent - start.size() : indent, ' ');
    for (const char c : wrap(meaning, 110 - indent)) text += c == '\n' ? '\n' + margin : std::string{c};
    return start + text + '\n';
}

Axis most_varied(const std::vector<Scene>& scenes) {
    std::set<Eigen::Index> numbers;
    std::set<double> leading, trailing, lambdas;
    bool equal = true;
    for (const Scene& scene : scenes) {
        numbers.insert(scene.n());
        leading.insert(scene.alpha_L.value_or(0));
        trailing.insert(scene.alpha_T.value_or(0));
        lambdas.insert(scene.lambda.value_or(1));
        equal = equal && scene.alpha_L == scene.alpha_T;
    }
    const std::size_t most = std::max({numbers.size(), leading.size(), trailing.size(), lambdas.size()});
    if (numbers.size() == most) return {"n", scenes.front().n_label()};
    if (trailing.size() == most && equal) return {"alpha_T", "α_L = α_T", {"alpha_L"}};
    const std::string column = trailing.size() == most ? "alpha_T" : leading.size() == most ? "alpha_L" : "lambda";
    return {column, shown_name(column)};
}

}  // namespace study
