// Creep curves with the exact border between slip and stick.
#include <algorithm>

#include "steady.hpp"
#include "studies/stick_border.hpp"
#include "support/timing.hpp"

namespace friction {

void solve_by_border(const Curve& curve, const study::Scene& scene, study::RowRange range, const See& see) {
    try {
        curve.line.system(scene, Line::Direction::longitudinal, false);
    } catch (const std::invalid_argument&) {
        return leave_out(scene, range, curve.line, see);
    }
    // tractions are taken at the centres of the cosine mesh, which also serves where the border has no exact
    // solution
    const Pressure& pressure = curve.line.pressure;
    const rollbem::Mesh<double> mesh = rollbem::cosine_mesh<double>(scene.n());
    for (std::size_t i = range.first; i < range.last; ++i) {
        const double unit = creepage_unit(scene);
        rollbem::studies::StickBorderSolution<double> found;
        const auto time_us = study::time_us_if(curve.timed, [&] {
            found = rollbem::studies::solve_stick_border(scene.contact, scene.kernel, 1.0, pressure,
                                                         unit * curve.points[i].longitudinal, scene.n());
            return found.force_per_width;
        });
        const std::optional<double> alpha = found.exact ? std::nullopt : std::optional(0.5);
        Solution solution{.mesh_name = found.exact ? "fitted" : "cosine",
                          .alpha_L = alpha,
                          .alpha_T = alpha,
                          .x = mesh.centres(),
                          .bound = pressure(mesh),
                          .full = mu_N,
                          .path_points = 0,
                          .traction = Eigen::MatrixXd::Zero(scene.n(), 2),
                          .slip = Eigen::MatrixXd::Zero(scene.n(), 2),
                          .time_us = time_us,
                          .status = name(found.status)};
        for (Eigen::Index k = 0; k < scene.n(); ++k) {
            const double x = mesh.centres()[k];
            if (found.exact) solution.bound[k] = pressure(x);
            solution.traction(k, 0) = found.traction(x);
            solution.slip(k, 0) = found.slip(x);
            solution.sticks.push_back(found.exact ? x > found.border : solution.slip(k, 0) == 0);
        }
        rollbem::FrictionStep& step = solution.step;
        step.force.longitudinal = found.force_per_width;
        step.tangent.by_longitudinal.longitudinal = found.tangent_per_width;
        step.slip_work = found.slip_work_per_width;
        step.stick_count = std::count(solution.sticks.begin(), solution.sticks.end(), true);
        step.rounds = found.evaluations;
        step.complementarity_residual = found.complementarity_residual;
        see(i, solution);
    }
}

}  // namespace friction
