// Non-steady rolling with Coulomb friction step by step, and rigid shifts without rolling.
// s/V = xi - G' p + G dp/dq, Eq. (1), with q = V t the distance rolled.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "friction_model.hpp"
#include "plane_model.hpp"
#include "transient.hpp"

namespace rollbem {

/// The contact as a force element with friction, stepped like TransientModel. Const and free of caches: threads may
/// share it.
///
/// Integrator::sdirk2 solves for stick and slip twice a step and is of second order in dq, forces and slip work alike;
/// implicit_euler solves once and is of first order. Both keep Coulomb's law at each of these solutions, and slip never
/// gains energy. Elements that begin to slip or stick within a step cost no order.
///
/// The scheme must be stable and converge, which nothing here checks: friction bounds the tractions of any other, but
/// they are wrong then, whatever the status. Ask before: verdict(matrices).stable() of stability.hpp, and the status of
/// solve_steady(matrices.G_prime, widths) of steady.hpp, which must not be inconsistent (alpha <= 0, or alpha > 1).
///
///     const FrictionModel<double> model(contact, mesh, scheme, kernel, friction);
///     State now = model.at_rest(), next = now;
///     const FrictionStep<double> step = model.advance(now, dq, creepage, next);  // now stays as it is
///     if (accepted) std::swap(now, next);
template <class Scalar_ = double>
class FrictionModel {
public:
    using Scalar = Scalar_;
    using State = FrictionState<Scalar>;
    using Step = FrictionStep<Scalar>;

    /// Throws std::invalid_argument as assemble and require_stable_model do, where the law breaks what CoulombFriction
    /// asks for, and for Integrator::matrix_exponential, which knows no friction.
    template <class Scheme, LineKernel Kernel>
    FrictionModel(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel,
                  const CoulombFriction<Scalar>& friction, Integrator integrator = Integrator::sdirk2)
        : FrictionModel(Checked{}, contact, assemble_model(mesh, scheme, kernel), unknown_widths(mesh, scheme),
                        detail::friction_bound("FrictionModel", friction, mesh.size(),
                                               unknown_count(scheme, mesh.size()), contact.shear_modulus()),
                        integrator) {}

    /// From ready matrices (G in units of a/G, G' in 1/G) and the widths of their elements (in units of a); the law has
    /// as many pressures. Throws std::invalid_argument as above and where sizes differ or an entry is not finite.
    FrictionModel(const Contact<Scalar>& contact, InfluenceMatrices<Scalar> matrices, const ArrayX<Scalar>& widths,
                  const CoulombFriction<Scalar>& friction, Integrator integrator = Integrator::sdirk2)
        : FrictionModel(
              Checked{}, contact, std::move(matrices), widths,
              detail::friction_bound("FrictionModel", friction, widths.size(), widths.size(), contact.shear_modulus()),
              integrator) {}

    Eigen::Index size() const { return core_.size(); }  ///< number of unknown elements
    Integrator integrator() const { return integrator_; }

    /// No traction anywhere, everything sticks.
    State at_rest() const { return core_.at_rest(); }

    /// 2b F_bar of a state [N]. The state must have size() elements.
    Scalar force(const State& state) const { return core_.force(state); }

    /// Steady rolling at a creepage [-], to start from: what SteadyFrictionModel::solve does.
    Step steady(const State& from, Scalar creepage, State& to) const noexcept {
        return core_.solve_steady(from, creepage, G_prime_, to);
    }

    /// Rolls on by dq [m], positive and finite, or 0 for a rigid shift without rolling. `from` is never written; `to`
    /// must be another state of this model. It is left alone where the status is invalid_step or wrong_state or the
    /// motion is not finite, and becomes a copy of `from` where the result is not finite. A `to` that has been used
    /// with this dq costs three products of a matrix and a vector for each solution while no element changes, and no
    /// allocation; a new dq costs a matrix inversion, and no allocation up to a hundred elements.
    Step advance(const State& from, Scalar dq, const RigidMotion<Scalar>& motion, State& to) const noexcept {
        if (!core_.fits(from, to)) return Core::failed(FrictionStatus::wrong_state);
        const bool shifts = motion.kind_ == RigidMotion<Scalar>::Kind::shift;
        const Scalar a = core_.half_length();
        const Scalar distance = dq / a;
        if (!(shifts ? distance >= 0 : distance > 0) || !std::isfinite(distance)) {
            return Core::failed(FrictionStatus::invalid_step);
        }
        if (!std::isfinite(motion.start_) || !std::isfinite(motion.end_)) {
            return Core::failed(FrictionStatus::not_finite);
        }
        // A stage takes `part` of the step: (s/V) part dq = xi part dq - (part dq G' - G) p - G p_memory.
        const bool two_stages = integrator_ == Integrator::sdirk2 && distance > 0;
        const Scalar part = two_stages ? gamma : Scalar(1);
        const Scalar travel = shifts ? part / a : part * distance;
        if (MatrixX<Scalar>* matrix = core_.claim(to, part * distance)) *matrix = G_ - (part * distance) * G_prime_;
        to.memory_ = from.traction_ / core_.shear_modulus();
        if (!two_stages) {
            set_constant(travel * motion.end_, to);
            return core_.solve(from, {.zones = from.zones_}, {.first = 0, .last = travel}, a, to);
        }
        const bool linear = motion.kind_ == RigidMotion<Scalar>::Kind::linear;
        set_constant(travel * (motion.start_ + gamma * (motion.end_ - motion.start_)), to);
        const typename Core::Before before = core_.solve_first(from, ratio, to);
        if (before.tangent_exists && to.carried_revision_ != to.solver_.revision()) {
            to.solver_.respond(VectorX<Scalar>::Ones(size()), to.response_);
            to.carried_.noalias() = G_ * to.response_;
            to.carried_ *= -ratio;
            to.carried_revision_ = to.solver_.revision();
            to.tangent_revision_ = State::never;
        }
        to.memory_ += ratio * (to.solver_.traction() - to.memory_);
        set_constant(travel * motion.end_, to);
        return core_.solve(from, before, {.first = linear ? gamma * travel : travel, .last = travel}, a, to);
    }

    /// A rigid shift [m] of body 1 on body 2, positive like creepage, without rolling.
    Step shift(const State& from, Scalar shift, State& to) const noexcept {
        return advance(from, 0, RigidMotion<Scalar>::shift(shift), to);
    }

private:
    using Core = detail::FrictionCore<Scalar>;

    // Alexander's two stages (1977): each takes gamma dq; the second starts from p + ratio (p_1 - p), p_1 the first's
    // result. The slip of a step is `ratio` times the first's and the second's.
    static constexpr Scalar gamma = 1 - std::numbers::sqrt2_v<Scalar> / 2;
    static constexpr Scalar ratio = 1 + std::numbers::sqrt2_v<Scalar>;  // (1 - gamma)/gamma

    struct Checked {};  // tells the constructor from those whose law may come in braces

    FrictionModel(Checked, const Contact<Scalar>& contact, InfluenceMatrices<Scalar> matrices,
                  const ArrayX<Scalar>& widths, VectorX<Scalar> bound, Integrator integrator)
        : core_(contact, widths, std::move(bound)),
          G_(std::move(matrices.G)),
          G_prime_(std::move(matrices.G_prime)),
          integrator_(integrator) {
        detail::check_influence("FrictionModel", G_, size());
        detail::check_influence("FrictionModel", G_prime_, size());
        detail::require(integrator != Integrator::matrix_exponential, "FrictionModel", "integrator",
                        static_cast<int>(integrator), "be implicit_euler (0) or sdirk2 (1)");
    }

    template <class Scheme, class Kernel>
    static InfluenceMatrices<Scalar> assemble_model(const Mesh<Scalar>& mesh, const Scheme& scheme,
                                                    const Kernel& kernel) {
        require_stable_model(kernel);
        return assemble(mesh, scheme, kernel);
    }

    // lengths in a
    void set_constant(Scalar imposed, State& to) const {
        VectorX<Scalar>& constant = core_.constant(to);
        constant.noalias() = G_ * to.memory_;
        constant = VectorX<Scalar>::Constant(size(), imposed) - constant;
    }

    Core core_;
    MatrixX<Scalar> G_, G_prime_;
    Integrator integrator_;
};

}  // namespace rollbem
