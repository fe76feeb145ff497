#include "mesh_names.hpp"

#include <cstddef>

namespace study {

std::vector<std::string> mesh_names() {
    std::vector<std::string> names;
    for (const rollbem::TopologyInfo& known : rollbem::topologies) names.emplace_back(known.name);
    return names;
}

std::vector<std::string> mesh_names(rollbem::Grading grading) {
    std::vector<std::string> names;
    for (const rollbem::TopologyInfo& known : rollbem::topologies) {
        if (known.grading == grading) names.emplace_back(known.name);
    }
    return names;
}

std::string listed(const std::vector<std::string>& words, const std::string& last) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 == words.size() ? " " + last + " " : ", ";
        text += words[i];
    }
    return text;
}

}  // namespace study
