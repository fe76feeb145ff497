// Steady rolling with Coulomb friction: s/V = xi - G' p, stick and slip found by the solver.
// One model for a whole creep curve; each point starts from the one before.
#pragma once

#include <utility>

#include "friction_model.hpp"

namespace rollbem {

/// Steady rolling of one contact, mesh, scheme and law of friction at any creepage. Const and free of caches: threads
/// may share it. Creepage xi > 0 gives a negative force.
///
/// The scheme must converge, which nothing here checks: the forces of one that does not (alpha <= 0, or alpha > 1) are
/// wrong wherever elements stick, whatever the status. Ask solve_steady(G_prime, widths) of steady.hpp before, whose
/// status must not be inconsistent. Steady rolling asks for no stability in time.
///
///     const SteadyFrictionModel<double> model(contact, mesh, scheme, kernel, friction);
///     State now = model.at_rest(), next = now;
///     for (double creepage : curve) {
///         const FrictionStep<double> point = model.solve(now, creepage, next);
///         std::swap(now, next);
///     }
template <class Scalar_ = double>
class SteadyFrictionModel {
public:
    using Scalar = Scalar_;
    using State = FrictionState<Scalar>;
    using Step = FrictionStep<Scalar>;

    /// Throws std::invalid_argument as assemble_G_prime does and where the law breaks what CoulombFriction asks for.
    template <class Scheme, LineKernel Kernel>
    SteadyFrictionModel(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme,
                        const Kernel& kernel, const CoulombFriction<Scalar>& friction)
        : SteadyFrictionModel(Checked{}, contact, assemble_G_prime(mesh, scheme, kernel), unknown_widths(mesh, scheme),
                              detail::friction_bound("SteadyFrictionModel", friction, mesh.size(),
                                                     unknown_count(scheme, mesh.size()), contact.shear_modulus())) {}

    /// From a ready G' (in units of 1/G) and the widths of its elements (in units of a); the law has as many
    /// pressures. Throws std::invalid_argument as above and where sizes differ or an entry is not finite.
    SteadyFrictionModel(const Contact<Scalar>& contact, MatrixX<Scalar> G_prime, const ArrayX<Scalar>& widths,
                        const CoulombFriction<Scalar>& friction)
        : SteadyFrictionModel(Checked{}, contact, std::move(G_prime), widths,
                              detail::friction_bound("SteadyFrictionModel", friction, widths.size(), widths.size(),
                                                     contact.shear_modulus())) {}

    Eigen::Index size() const { return core_.size(); }  ///< number of unknown elements

    /// No traction anywhere, everything sticks: the start of a first solution.
    State at_rest() const { return core_.at_rest(); }

    /// The solution at a creepage [-], sought from the zones of `from`. `to` must be another state of this model; it
    /// is left alone where the status is wrong_state or the creepage is not finite. A `to` that was used before costs
    /// no allocation up to a hundred elements.
    Step solve(const State& from, Scalar creepage, State& to) const noexcept {
        return core_.solve_steady(from, creepage, G_prime_, to);
    }

private:
    using Core = detail::FrictionCore<Scalar>;

    struct Checked {};  // tells the constructor from the one whose law may come in braces

    SteadyFrictionModel(Checked, const Contact<Scalar>& contact, MatrixX<Scalar> G_prime, const ArrayX<Scalar>& widths,
                        VectorX<Scalar> bound)
        : core_(contact, widths, std::move(bound)), G_prime_(std::move(G_prime)) {
        detail::check_influence("SteadyFrictionModel", G_prime_, size());
    }

    Core core_;
    MatrixX<Scalar> G_prime_;
};

}  // namespace rollbem
