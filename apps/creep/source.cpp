#include "source.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace creep {

namespace {

using rollbem::Creepage;

constexpr rollbem::NodeDifference scheme{rollbem::Nodes::chebyshev};

/// Elements so long that n^2 of them have the least error where spin is large. That error comes from the pole of the
/// slip, where one element turns at once, so it falls if strips are equally wide and their number follows the ellipse:
/// with 256 elements, by the sum over the elements in full sliding against full_sliding() at a/b = 0.1, 0.3, 1, 3, 10,
/// from 5.1e-2, 2.0e-2, 1.2e-2, 1.8e-2, 4.4e-2 (16 x 16, strips graded by the cosine) to 1.0e-2, 0.9e-2, 0.8e-2,
/// 1.1e-2, 1.9e-2 (the largest of 300 random directions). Strips are even in number: the pole of a lateral force and
/// spin moves on y = 0, and if elements lay there they could slip to either side of it, which breaks the symmetry of
/// the discrete problem.
rollbem::PatchMesh<double> mesh_of(const rollbem::PatchContact<double>& contact, std::ptrdiff_t n) {
    const double per_strip = std::clamp(std::pow(contact.a_over_b(), 0.6), 0.25, 2.0), side = static_cast<double>(n);
    const long along = std::max(std::lround(side * std::sqrt(per_strip)), 2L);
    const long across = 2 * std::max(std::lround(side * side / static_cast<double>(2 * along)), 1L);
    return rollbem::patch_mesh(contact, rollbem::cosine_mesh(std::min(along, 2 * across)),
                               rollbem::uniform_mesh(across));
}

}  // namespace

// a = G = 1, mu N = G a b: creepages are the given numbers, a force over mu N is one over b
Source::Source(double a_over_b, double poisson_ratio, std::ptrdiff_t n)
    : contact_(rollbem::PatchContact<double>::dimensionless(a_over_b, poisson_ratio)),
      mesh_(mesh_of(contact_, n)),
      model_(contact_, mesh_, scheme, rollbem::HalfSpace<double>(poisson_ratio),
             {1.0, rollbem::hertz_pressures(contact_, mesh_, contact_.half_width())}),
      workspace_(model_.workspace()),
      rest_(model_.at_rest()),
      last_(rest_),
      next_(rest_) {}

rollbem::CreepCoefficients<double> Source::coefficients() const {
    return rollbem::solve_steady(contact_, mesh_, scheme, rollbem::HalfSpace<double>(contact_.poisson_ratio()));
}

Source::Solution Source::solve(const Creepage<double>& creepage, bool from_rest) {
    const Creepage<double> given{creepage.longitudinal, creepage.lateral, creepage.spin / contact_.c()};
    Solution solution;
    solution.step = model_.steady(from_rest ? rest_ : last_, given, next_, workspace_);
    if (!from_rest && solution.step.status == rollbem::StepStatus::no_solution) return solve(creepage, true);
    std::swap(last_, next_);
    const auto& force = solution.step.force;
    solution.force =
        -Eigen::Array3d(force.longitudinal, force.lateral, force.moment / contact_.c()) / contact_.half_width();
    return solution;
}

}  // namespace creep
