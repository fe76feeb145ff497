// What the steady and the non-steady friction problem share: Coulomb's law on a mesh, states and results.
// A state is a value: a copy is a checkpoint.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "../assembly/influence.hpp"
#include "../detail/require.hpp"
#include "../discretisation/mesh.hpp"
#include "../scene/contact.hpp"
#include "friction_active_set.hpp"

namespace rollbem {

/// Coulomb's law |p| <= mu p_n on the elements of a mesh. Where they slip, p = -mu p_n sign(s).
template <class Scalar>
struct CoulombFriction {
    Scalar friction_coefficient;     ///< mu [-], finite and not negative
    ArrayX<Scalar> normal_pressure;  ///< p_n [Pa], the mean of each of the mesh's n elements, trailing to leading;
                                     ///< finite, not negative, not all zero
};

namespace detail {
template <class Scalar>
class FrictionCore;
}

/// Tractions and what else a friction problem knows of its elements. Made by a model, and for that model alone.
template <class Scalar_>
class FrictionState {
public:
    using Scalar = Scalar_;

    /// p on body 1 of each unknown element [Pa], trailing to leading.
    const VectorX<Scalar>& traction() const { return traction_; }
    /// Slip of body 1 on body 2: after a non-steady step or a rigid shift the distance slid meanwhile [m]; after a
    /// steady solution the slip velocity over the rolling velocity, s/V [-].
    const VectorX<Scalar>& slip() const { return slip_; }
    /// What each element does.
    const std::vector<Zone>& zones() const { return zones_; }

private:
    explicit FrictionState(Eigen::Index n)
        : traction_(VectorX<Scalar>::Zero(n)),
          slip_(VectorX<Scalar>::Zero(n)),
          zones_(static_cast<std::size_t>(n), Zone::stick),
          solver_(n) {}

    VectorX<Scalar> traction_, slip_;
    std::vector<Zone> zones_;

    // The solver keeps its matrix and transform between steps. They are those of the model whose mark is kept too (the
    // shared ownership keeps an address from meaning two models) and of the distance rolled.
    detail::ActiveSet<Scalar> solver_;
    std::shared_ptr<const int> model_;
    Scalar distance_ = -1;
    Scalar unit_tangent_ = 0;  // sum of areas times dp/dc
    unsigned long tangent_revision_ = std::numeric_limits<unsigned long>::max();

    template <class>
    friend class detail::FrictionCore;
    template <class>
    friend class FrictionModel;
};

/// Result of a steady solution, a step or a rigid shift. Per unit width of a contact that is plane across, y = 0.
/// Forces and work are not a number where the status is neither ok nor no_solution.
template <class Scalar>
struct FrictionStep {
    Scalar force_per_width = std::numeric_limits<Scalar>::quiet_NaN();  ///< F_bar on body 1 [N/m]
    Scalar force = std::numeric_limits<Scalar>::quiet_NaN();            ///< 2b F_bar [N]; infinite for infinite b
    /// d force_per_width / d creepage at the end of the step [N/m]; for a rigid shift by the shift [N/m^2]. Not a number
    /// where the matrix of the stick elements is singular.
    Scalar tangent_per_width = std::numeric_limits<Scalar>::quiet_NaN();
    /// Work that slip turns into heat, never negative: of a step or a shift per unit width [J/m]; of a steady solution per
    /// unit width and unit distance rolled [J/m^2].
    Scalar slip_work_per_width = std::numeric_limits<Scalar>::quiet_NaN();
    /// Largest violation of |p| <= mu p_n (over the largest mu p_n) and of s (over the largest imposed slip).
    Scalar complementarity_residual = std::numeric_limits<Scalar>::quiet_NaN();
    Eigen::Index stick_count = 0;  ///< elements that stick
    int rounds = 0;                ///< rounds of the active set
    int pivots = 0;                ///< pivots of the fallback; 0 where the rounds settled
    FrictionStatus status = FrictionStatus::ok;
};

namespace detail {

/// mu p_n / G of the unknown elements (the first `count` of the mesh), after all checks of the law.
template <class Scalar>
VectorX<Scalar> friction_bound(const char* who, const CoulombFriction<Scalar>& friction, Eigen::Index mesh_size,
                               Eigen::Index count, Scalar shear_modulus) {
    require(friction.friction_coefficient >= 0 && std::isfinite(friction.friction_coefficient), who,
            "friction_coefficient", friction.friction_coefficient, "be finite and not negative");
    require(friction.normal_pressure.size() == mesh_size, who, "length of normal_pressure",
            friction.normal_pressure.size(), "equal the number of elements");
    for (Eigen::Index i = 0; i < mesh_size; ++i) {
        require(friction.normal_pressure[i] >= 0 && std::isfinite(friction.normal_pressure[i]), who, "normal_pressure",
                friction.normal_pressure[i], "be finite and not negative");
    }
    require(friction.normal_pressure.maxCoeff() > 0, who, "largest normal_pressure",
            friction.normal_pressure.maxCoeff(), "be positive");
    return friction.friction_coefficient / shear_modulus * friction.normal_pressure.head(count).matrix();
}

template <class Scalar>
void check_influence(const char* who, const MatrixX<Scalar>& matrix, Eigen::Index n) {
    require(matrix.rows() == n && matrix.cols() == n, who, "size of an influence matrix",
            matrix.rows() != n ? matrix.rows() : matrix.cols(), "equal the number of unknown elements");
    require(matrix.allFinite(), who, "largest entry of an influence matrix", matrix.cwiseAbs().maxCoeff(), "be finite");
}

/// The part of a friction model that does not know where its equations s = M p + c come from. Dimensionless: tractions
/// in G, lengths in a.
template <class Scalar>
class FrictionCore {
public:
    using State = FrictionState<Scalar>;
    using Step = FrictionStep<Scalar>;

    /// `widths` in a, `bound` = mu p_n / G.
    FrictionCore(const Contact<Scalar>& contact, const ArrayX<Scalar>& widths, VectorX<Scalar> bound)
        : half_length_(contact.half_length()),
          width_(2 * contact.half_width()),
          shear_modulus_(contact.shear_modulus()),
          widths_(widths.matrix()),
          bound_(std::move(bound)) {}

    Eigen::Index size() const { return widths_.size(); }
    Scalar half_length() const { return half_length_; }
    Scalar shear_modulus() const { return shear_modulus_; }
    State at_rest() const { return State(size()); }

    bool fits(const State& from, const State& to) const noexcept {
        return &from != &to && from.traction_.size() == size() && to.traction_.size() == size();
    }

    static Step failed(FrictionStatus status) noexcept {
        Step step;
        step.status = status;
        return step;
    }

    /// The matrix to fill for a distance rolled, or nothing when `to` has it already.
    MatrixX<Scalar>* claim(State& to, Scalar distance) const noexcept {
        if (to.model_ == mark_ && to.distance_ == distance) return nullptr;
        to.model_ = mark_;
        to.distance_ = distance;
        to.solver_.invalidate();
        return &to.solver_.matrix();
    }

    VectorX<Scalar>& constant(State& to) const noexcept { return to.solver_.constant(); }

    /// Solves from the zones of `from` and fills `to`. `gain` is dc / d creepage (or shift); slip is multiplied by
    /// `slip_unit` for the state.
    Step solve(const State& from, Scalar gain, Scalar slip_unit, State& to) const noexcept {
        ActiveSet<Scalar>& solver = to.solver_;
        const typename ActiveSet<Scalar>::Outcome outcome = solver.solve(bound_, from.zones_);
        const Scalar force = widths_.dot(solver.traction());
        // stick leaves rounding behind, and so may the border of slip
        to.slip_ = solver.signs().cwiseProduct(solver.signs().cwiseProduct(solver.slip()).cwiseMax(Scalar(0)));
        const Scalar work = -widths_.cwiseProduct(solver.traction()).dot(to.slip_);
        if (!std::isfinite(force) || !std::isfinite(work)) {
            solver.invalidate();
            to.traction_ = from.traction_;
            to.slip_ = from.slip_;
            to.zones_ = from.zones_;
            return failed(FrictionStatus::not_finite);
        }
        to.zones_ = solver.zones();
        to.traction_ = shear_modulus_ * solver.traction();
        to.slip_ *= slip_unit;
        Step step;
        step.stick_count = solver.stick_count();
        step.force_per_width = half_length_ * shear_modulus_ * force;
        step.force = width_ * step.force_per_width;
        step.slip_work_per_width = half_length_ * shear_modulus_ * slip_unit * work;
        if (outcome.tangent_exists) {
            if (to.tangent_revision_ != solver.revision()) {
                to.unit_tangent_ = solver.tangent(widths_);
                to.tangent_revision_ = solver.revision();
            }
            step.tangent_per_width = half_length_ * shear_modulus_ * gain * to.unit_tangent_;
        }
        step.complementarity_residual = outcome.residual;
        step.rounds = outcome.rounds;
        step.pivots = outcome.pivots;
        step.status = outcome.status;
        return step;
    }

private:
    Scalar half_length_, width_, shear_modulus_;  // a [m], 2b [m], G [Pa]
    VectorX<Scalar> widths_, bound_;
    std::shared_ptr<const int> mark_ = std::make_shared<const int>(0);
};

}  // namespace detail

#ifdef ROLLBEM_INSTANCES  // compiled once for all programs of this project
extern template class detail::FrictionCore<double>;
#endif

}  // namespace rollbem
