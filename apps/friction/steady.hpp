// The modes of friction_study: steady rolling, creep curves by elements or with the exact stick border, and time.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "line.hpp"
#include "support/options.hpp"
#include "support/plot.hpp"
#include "support/table.hpp"

namespace friction {

/// Steady rolling at several creepages.
struct Curve {
    Line line;
    std::vector<study::Scene> scenes;
    std::vector<CreepPoint> points;
    bool timed;
    bool by_border;                 ///< with the exact border between slip and stick
    bool keeps_tractions;           ///< for a file or a picture
    std::string sweep{};            ///< up or down: each point starts from its neighbour; empty: from scratch
    std::optional<double> force{};  ///< -F_x/(mu N) in place of the longitudinal creepages
};

/// Rolling in time.
struct Scenario {
    Line line;
    std::vector<study::Scene> scenes;
    study::Run run;
    bool creepage_swept, creepage_constant;  ///< along x

    /// Just before (or at) q.
    CreepPoint at(double q) const {
        const auto value = [&](const char* column) { return run.imposed.at(column, q, false); };
        const std::optional<double> lateral = line.both ? std::optional(value("lateral_ratio")) : std::nullopt;
        return {value("creepage_ratio"), lateral, value("spin_ratio")};
    }
};

/// The solution at a point of a creep curve.
struct Solution {
    std::string mesh_name;
    std::optional<double> alpha_L, alpha_T;
    Eigen::ArrayXd x;                        ///< centres of the elements
    Eigen::ArrayXd bound;                    ///< of every element [mu p0]
    double full = 1;                         ///< force of full sliding, in the unit of the step's
    rollbem::FrictionStep step{};            ///< without numbers where there is no solution
    std::optional<double> creepage_ratio{};  ///< found for a force; not a number where there is none
    std::optional<int> path_points{};
    Eigen::MatrixXd traction{}, slip{};  ///< in both directions [mu p0, V mu p0/G]
    std::vector<bool> sticks{};
    Eigen::ArrayXd friction{};  ///< mu/mu_0; empty where it is constant
    study::Cell time_us{}, assembly_us{};
    std::string status{};
};

using See = std::function<void(std::size_t point, const Solution&)>;

/// Solves the points of `range`, which do not depend on points before: each from scratch, or in a sweep after its
/// neighbours.
void solve_by_elements(const Curve& curve, const study::Scene& scene, study::RowRange range, const See& see);
void solve_by_border(const Curve& curve, const study::Scene& scene, study::RowRange range, const See& see);

/// The points without a solution, where G' is not finite, as for b/a or a layer near the limits of double.
void leave_out(const study::Scene& scene, study::RowRange range, const Line& line, const See& see);

/// The columns that may be imposed in the time domain.
inline const study::HistoryColumns history_columns{
    {"creepage_ratio", "lateral_ratio", "spin_ratio"}, {"shift"}, {"load_ratio"}, {"speed"}};

// --- the options, read at the door. The readers throw BadInput.

void add_options(study::Options& options);
Curve read_curve(const study::Options& options);
Pressure read_pressure(const study::Options& options);  ///< of --pressure, else Hertz's
Scenario read_scenario(const study::Options& options);

// --- the modes: their columns and meanings, and their tables, which refer to the scene

std::string curve_help();
std::string transient_help();
study::Table curve_table(const Curve& curve);
study::Table transient_table(const Scenario& scenario);

}  // namespace friction
