// The modes of friction_study: steady rolling, creep curves by elements or with the exact stick border, and time.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "line.hpp"
#include "support/plot.hpp"
#include "tractions.hpp"

namespace friction {

struct Curve {
    Line line;
    std::vector<CreepPoint> points;
    std::string sweep;  ///< up or down: each point starts from its neighbour; empty: from scratch
    bool timed;
    std::optional<double> force{};  ///< -F_x/(mu N) in place of the longitudinal creepages
};

/// What was found at a point.
struct Solution {
    std::string mesh_name;
    std::optional<double> alpha_L, alpha_T;
    Eigen::ArrayXd x;                        ///< centres of the elements
    Eigen::ArrayXd bound;                    ///< of every element [mu p0]
    double full = 1;                         ///< force of full sliding, in the unit of the step's
    rollbem::FrictionStep<2> step{};         ///< without numbers where there is no solution
    std::optional<double> creepage_ratio{};  ///< found for a force; not a number where there is none
    std::optional<int> path_points{};
    Eigen::MatrixXd traction{}, slip{};  ///< in both directions [mu p0, V mu p0/G]
    std::vector<bool> sticks{};
    Eigen::ArrayXd friction{};  ///< mu/mu_0; empty where it is constant
    study::Cell time_us{}, assembly_us{};
    std::string status{};
};

using See = std::function<void(std::size_t point, const Solution&)>;

/// Solves the points of `range`, which do not depend on those before: each from scratch, or in a sweep after its
/// neighbours.
void solve_by_elements(const Curve& curve, const study::Scene& scene, study::RowRange range, const See& see);
void solve_by_border(const Curve& curve, const study::Scene& scene, study::RowRange range, const See& see);

/// The points without a solution, where G' is not finite, as for b/a or a layer near the limits of double.
void leave_out(const study::Scene& scene, study::RowRange range, const Line& line, const See& see);

/// What may be imposed in the time domain.
inline const study::HistoryColumns history_columns{
    {"creepage_ratio", "lateral_ratio", "spin_ratio"}, {"shift"}, {"force", "load_ratio", "speed"}};

// --- the modes: their columns and meanings, and what writes their tables and throws what write_table throws

std::string creep_help();
std::string transient_help();
void run_steady(const study::Options& options);
void run_transient(const study::Options& options);

}  // namespace friction
