// The laws of friction that programs offer by an option: one row of a table each.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/friction/law.hpp>

#include "options.hpp"
#include "sheet.hpp"

namespace study {

/// mu/mu_0 as a function of the slip velocity [V mu_0 p0/G]. Option, columns and checks of its parameters follow from
/// the row.
struct FrictionLawRow {
    struct Parameter {
        std::string column, meaning;  ///< an empty meaning is that of the column before
    };

    std::string option;  ///< --OPTION gives the parameters, separated by commas
    std::string values;  ///< their names in --help
    std::string help;
    std::vector<Parameter> parameters;
    std::string rule;  ///< "be ...", what finite parameters must satisfy, as `holds` checks it
    bool (*holds)(const std::vector<double>& parameters);
    rollbem::Friction::Law (*law)(const std::vector<double>& parameters);
    std::vector<std::string> title;  ///< a text before each parameter
};

const std::vector<FrictionLawRow>& friction_laws();
std::vector<std::string> friction_law_options();
/// The options of all laws in a sentence: --falling, or --ONE or --OTHER.
std::string friction_law_flags();

/// A law with its parameters and memory; velocities in V mu_0 p0/G, distances in a mu_0 p0/G.
struct ChosenLaw {
    const FrictionLawRow* row;
    std::vector<double> parameters;
    rollbem::Friction::Memory memory{};

    rollbem::Friction::Law law() const { return row->law(parameters); }
};

/// The options of all laws, of which one may be given, and --memory.
void add_friction_laws(Options& options);
/// The law that is given; nothing where mu is constant.
std::optional<ChosenLaw> read_friction_law(const Options& options);
/// The law and its memory as given, for titles, each after ", "; empty where mu is constant.
std::string friction_law_title(const Options& options);

/// The parameters of the laws and of the memory, of rows whose law is law_of(row).
template <class Row, class LawOf>
std::vector<Column<Row>> friction_law_columns(const LawOf& law_of) {
    std::vector<Column<Row>> columns;
    for (const FrictionLawRow& row : friction_laws()) {
        for (std::size_t k = 0; k < row.parameters.size(); ++k) {
            const auto& [column, meaning] = row.parameters[k];
            columns.push_back({column, meaning, [=, own = &row](const Row& r) {
                                   const std::optional<ChosenLaw>& law = law_of(r);
                                   return law && law->row == own ? Cell(law->parameters[k]) : Cell();
                               }});
        }
    }
    const auto of_memory = [=](double rollbem::Friction::Memory::*member) {
        return [=](const Row& r) { return law_of(r) ? Cell((*law_of(r)).memory.*member) : Cell(); };
    };
    columns.push_back({"memory_distance", "parameters of --memory", of_memory(&rollbem::Friction::Memory::distance)});
    columns.push_back({"least_velocity", "", of_memory(&rollbem::Friction::Memory::least_velocity)});
    return columns;
}

}  // namespace study
