// Non-steady rolling with Coulomb friction, one implicit step at a time, and rigid shifts without rolling.
// (s/V) dq = xi dq - (dq G' - G) p - G p_old with q = V t the distance rolled.
#pragma once

#include <cmath>
#include <utility>

#include "friction_model.hpp"

namespace rollbem {

/// The contact as a force element with friction, by implicit Euler: first order in dq. Const and free of caches: threads
/// may share it.
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

    /// Throws std::invalid_argument as assemble() does and where the law breaks what CoulombFriction asks for.
    template <class Scheme, LineKernel Kernel>
    FrictionModel(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel,
                  const CoulombFriction<Scalar>& friction)
        : FrictionModel(contact, assemble(mesh, scheme, kernel), unknown_widths(mesh, scheme),
                        detail::friction_bound("FrictionModel", friction, mesh.size(),
                                               unknown_count(scheme, mesh.size()), contact.shear_modulus())) {}

    /// From ready matrices (G in units of a/G, G' in 1/G) and the widths of their elements (in units of a); the law has
    /// as many pressures. Throws std::invalid_argument as above and where sizes differ or an entry is not finite.
    FrictionModel(const Contact<Scalar>& contact, InfluenceMatrices<Scalar> matrices, const ArrayX<Scalar>& widths,
                  const CoulombFriction<Scalar>& friction)
        : FrictionModel(contact, std::move(matrices), widths,
                        detail::friction_bound("FrictionModel", friction, widths.size(), widths.size(),
                                               contact.shear_modulus())) {}

    Eigen::Index size() const { return core_.size(); }  ///< number of unknown elements

    /// No traction anywhere, everything sticks.
    State at_rest() const { return core_.at_rest(); }

    /// The state of steady rolling at a creepage [-], to start from. Throws std::invalid_argument unless it is finite.
    State steady(Scalar creepage) const {
        detail::require(std::isfinite(creepage), "FrictionModel", "creepage", creepage, "be finite");
        const State rest = at_rest();
        State state = rest;
        *core_.claim(state, 0) = -G_prime_;
        core_.constant(state).setConstant(creepage);
        core_.solve(rest, 1, 1, state);
        return state;
    }

    /// Rolls on by dq [m], positive and finite, at a creepage [-]. `from` is never written; `to` must be another state
    /// of this model. It is left alone where the status is invalid_step or wrong_state or the creepage is not finite, and
    /// becomes a copy of `from` where the result is not finite. A `to` that has been used with this dq costs three products
    /// of a matrix and a vector while no element changes, and no allocation; a new dq costs a matrix inversion, and
    /// no allocation up to a hundred elements.
    Step advance(const State& from, Scalar dq, Scalar creepage, State& to) const noexcept {
        if (!core_.fits(from, to)) return Core::failed(FrictionStatus::wrong_state);
        const Scalar distance = dq / core_.half_length();
        if (!(distance > 0) || !std::isfinite(distance)) return Core::failed(FrictionStatus::invalid_step);
        return take(from, distance, creepage * distance, distance, to);
    }

    /// A rigid shift [m] of body 1 on body 2, positive like creepage, without rolling. Otherwise as above.
    Step shift(const State& from, Scalar shift, State& to) const noexcept {
        if (!core_.fits(from, to)) return Core::failed(FrictionStatus::wrong_state);
        return take(from, 0, shift / core_.half_length(), 1 / core_.half_length(), to);
    }

private:
    using Core = detail::FrictionCore<Scalar>;

    FrictionModel(const Contact<Scalar>& contact, InfluenceMatrices<Scalar> matrices, const ArrayX<Scalar>& widths,
                  VectorX<Scalar> bound)
        : core_(contact, widths, std::move(bound)), G_(std::move(matrices.G)), G_prime_(std::move(matrices.G_prime)) {
        detail::check_influence("FrictionModel", G_, size());
        detail::check_influence("FrictionModel", G_prime_, size());
    }

    // lengths in a
    Step take(const State& from, Scalar distance, Scalar shift, Scalar gain, State& to) const noexcept {
        if (!std::isfinite(shift)) return Core::failed(FrictionStatus::not_finite);
        if (MatrixX<Scalar>* matrix = core_.claim(to, distance)) *matrix = G_ - distance * G_prime_;
        VectorX<Scalar>& constant = core_.constant(to);
        constant.noalias() = G_ * from.traction_;
        constant = (-1 / core_.shear_modulus()) * constant + VectorX<Scalar>::Constant(size(), shift);
        return core_.solve(from, gain, core_.half_length(), to);
    }

    Core core_;
    MatrixX<Scalar> G_, G_prime_;
};

#ifdef ROLLBEM_INSTANCES  // compiled once for all programs of this project
extern template class FrictionModel<double>;
#endif

}  // namespace rollbem
