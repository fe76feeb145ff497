// The patches that tables of creep forces are made from.
#pragma once

#include <cstddef>
#include <optional>

#include <Eigen/Core>

#include <rollbem/adhesion/patch_steady.hpp>
#include <rollbem/friction/steady.hpp>
#include <rollbem/normal/patch_pressure.hpp>
#include <rollbem/scene/creep_coefficients.hpp>

namespace creep {

/// Steady forces of one ellipse by about n^2 elements; under large spin with its pole on the ellipse or near its edge, a
/// mean of two meshes.
class Source {
public:
    Source(double a_over_b, double poisson_ratio, std::ptrdiff_t n);

    const rollbem::PatchContact<double>& contact() const { return contact_; }
    const rollbem::PatchMesh<double>& mesh() const { return patch_.mesh; }  ///< the first of the two
    /// In full adhesion, of the same elements.
    rollbem::PatchSteadySolution<double> coefficients() const;

    struct Solution {
        Eigen::Array3d force;           ///< -F_x, -F_y over mu N, -M_z over mu N c; to be used if the status is ok
        rollbem::FrictionStep<2> step;  ///< of the first mesh; its status and its residual are the worse of the two
    };
    /// Creepages times G a b/(mu N), spin times G a b c/(mu N), from the tractions of the last solution or from rest.
    Solution solve(const rollbem::Creepage<double>& creepage, bool from_rest);

private:
    /// The ellipse on one mesh.
    struct Patch {
        Patch(const rollbem::PatchContact<double>& contact, rollbem::PatchMesh<double> given);
        Solution solve(const rollbem::PatchContact<double>& contact, const rollbem::Creepage<double>& creepage,
                       bool from_rest);

        rollbem::PatchMesh<double> mesh;
        rollbem::SteadyFrictionModel<rollbem::ConstantFriction<double>, 2> model;
        rollbem::FrictionWorkspace<2> workspace;
        rollbem::FrictionState<2> rest, last, next;
    };

    rollbem::PatchContact<double> contact_;
    Patch patch_;
    std::optional<Patch> shifted_;  ///< made when it is first needed
};

}  // namespace creep
