// The patches that creep_table takes its forces from.
#pragma once

#include <Eigen/Core>

#include <rollbem/adhesion/patch_steady.hpp>
#include <rollbem/friction/steady.hpp>
#include <rollbem/normal/patch_pressure.hpp>
#include <rollbem/scene/creep_coefficients.hpp>

namespace creep {

/// Steady forces of one ellipse by about n^2 elements.
class Source {
public:
    Source(double a_over_b, double poisson_ratio, std::ptrdiff_t n);

    const rollbem::PatchContact<double>& contact() const { return contact_; }
    const rollbem::PatchMesh<double>& mesh() const { return mesh_; }
    /// In full adhesion, of the same elements.
    rollbem::CreepCoefficients<double> coefficients() const;

    struct Solution {
        Eigen::Array3d force;  ///< -F_x, -F_y over mu N, -M_z over mu N c; to be used if the status is ok
        rollbem::FrictionStep<2> step;
    };
    /// Creepages times G a b/(mu N), spin times G a b c/(mu N), from the tractions of the last solution or from rest.
    Solution solve(const rollbem::Creepage<double>& creepage, bool from_rest);

private:
    using Model = rollbem::SteadyFrictionModel<rollbem::ConstantFriction<double>, 2>;

    rollbem::PatchContact<double> contact_;
    rollbem::PatchMesh<double> mesh_;
    Model model_;
    rollbem::FrictionWorkspace<2> workspace_;
    rollbem::FrictionState<2> rest_, last_, next_;
};

}  // namespace creep
