// What the steady and the non-steady friction problem share: Coulomb's law on a mesh, states and results.
// A state is a value: a copy is a checkpoint.
#pragma once

#include <algorithm>
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
    /// What each element does; after a step, at its end.
    const std::vector<Zone>& zones() const { return zones_; }

private:
    explicit FrictionState(Eigen::Index n)
        : traction_(VectorX<Scalar>::Zero(n)),
          slip_(VectorX<Scalar>::Zero(n)),
          zones_(static_cast<std::size_t>(n), Zone::stick),
          solver_(n),
          memory_(VectorX<Scalar>::Zero(n)),
          carried_(VectorX<Scalar>::Zero(n)),
          response_(VectorX<Scalar>::Zero(n)) {}

    VectorX<Scalar> traction_, slip_;
    std::vector<Zone> zones_;

    // The solver keeps its matrix and transform between steps. They are those of the model whose mark is kept too (the
    // shared ownership keeps an address from meaning two models) and of the distance rolled.
    detail::ActiveSet<Scalar> solver_;
    std::shared_ptr<const int> model_;
    Scalar distance_ = -1;
    VectorX<Scalar> memory_;   // tractions that the present stage of a step starts from
    VectorX<Scalar> carried_;  // dc of the last stage by dc of the first
    VectorX<Scalar> response_;
    Scalar unit_tangent_ = 0, carried_tangent_ = 0;  // sum of areas times dp, by dc of the last stage and of the first
    static constexpr unsigned long never = std::numeric_limits<unsigned long>::max();
    unsigned long tangent_revision_ = never, carried_revision_ = never;

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
    /// d force_per_width / d creepage at the end of the step [N/m]; for a rigid shift by the shift [N/m^2]. Not a
    /// number where the matrix of the stick elements is singular.
    Scalar tangent_per_width = std::numeric_limits<Scalar>::quiet_NaN();
    Scalar tangent = std::numeric_limits<Scalar>::quiet_NaN();  ///< the same of the force: 2b times it; infinite with b
    /// Work that slip turns into heat, never negative: of a step or a shift per unit width [J/m]; of a steady solution
    /// per unit width and unit distance rolled [J/m^2]. The sum over the elements: of first order in 1/n, and in steady
    /// rolling below -F_bar xi, what it tends to (n = 40, creepage ratios of 0.2, 0.5 and 0.8: by 13, 7 and 4 %).
    Scalar slip_work_per_width = std::numeric_limits<Scalar>::quiet_NaN();
    /// Largest violation of |p| <= mu p_n (over the largest mu p_n) and of s (over the largest slip there would be
    /// without traction).
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
    Scalar force(const State& state) const { return width_ * half_length_ * widths_.dot(state.traction_); }

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

    /// What is known before the last stage of a step: the slip of the first, whose zones the last starts from.
    struct Before {
        const std::vector<Zone>& zones;
        Scalar work = 0, residual = 0;
        int rounds = 0, pivots = 0;
        bool tangent_exists = true, solved = true;
    };
    /// dc of the first and of the last stage by what the tangent is taken by.
    struct Gain {
        Scalar first, last;
    };

    /// The first of two stages: solves from the zones of `from`, and begins the slip of `to` with `weight` times its
    /// own.
    Before solve_first(const State& from, Scalar weight, State& to) const noexcept {
        ActiveSet<Scalar>& solver = to.solver_;
        const typename ActiveSet<Scalar>::Outcome outcome = solver.solve(bound_, from.zones_);
        set_slip(to);
        to.slip_ *= weight;
        return {.zones = solver.zones(),
                .work = work(to),
                .residual = outcome.residual,
                .rounds = outcome.rounds,
                .pivots = outcome.pivots,
                .tangent_exists = outcome.tangent_exists,
                .solved = outcome.status == FrictionStatus::ok};
    }

    /// The last or only stage. Fills `to`, whose slip is multiplied by `slip_unit`.
    Step solve(const State& from, const Before& before, const Gain& gain, Scalar slip_unit, State& to) const noexcept {
        ActiveSet<Scalar>& solver = to.solver_;
        const bool only = &before.zones == &from.zones_;
        if (!only) to.response_ = to.slip_;
        const typename ActiveSet<Scalar>::Outcome outcome = solver.solve(bound_, before.zones);
        const Scalar force = widths_.dot(solver.traction());
        set_slip(to);
        const Scalar total_work = before.work + work(to);
        if (!std::isfinite(force) || !std::isfinite(total_work)) {
            solver.invalidate();
            to.traction_ = from.traction_;
            to.slip_ = from.slip_;
            to.zones_ = from.zones_;
            return failed(FrictionStatus::not_finite);
        }
        if (!only) to.slip_ += to.response_;
        to.slip_ *= slip_unit;
        to.zones_ = solver.zones();
        to.traction_ = shear_modulus_ * solver.traction();
        Step step;
        step.stick_count = solver.stick_count();
        step.force_per_width = half_length_ * shear_modulus_ * force;
        step.force = width_ * step.force_per_width;
        step.slip_work_per_width = half_length_ * shear_modulus_ * slip_unit * total_work;
        if (before.tangent_exists && outcome.tangent_exists) {
            step.tangent_per_width = half_length_ * shear_modulus_ * tangent(gain, to);
            step.tangent = width_ * step.tangent_per_width;
        }
        step.complementarity_residual = std::max(before.residual, outcome.residual);
        step.rounds = before.rounds + outcome.rounds;
        step.pivots = before.pivots + outcome.pivots;
        step.status = before.solved ? outcome.status : FrictionStatus::no_solution;
        return step;
    }

    /// Steady rolling, s/V = creepage - G' p, sought from the zones of `from`.
    Step solve_steady(const State& from, Scalar creepage, const MatrixX<Scalar>& G_prime, State& to) const noexcept {
        if (!fits(from, to)) return failed(FrictionStatus::wrong_state);
        if (!std::isfinite(creepage)) return failed(FrictionStatus::not_finite);
        if (MatrixX<Scalar>* matrix = claim(to, steadily)) *matrix = -G_prime;
        constant(to).setConstant(creepage);
        return solve(from, {.zones = from.zones_}, {.first = 0, .last = 1}, 1, to);
    }

private:
    static constexpr Scalar steadily = -1;  // in place of a distance rolled, which is 0 for a rigid shift

    // stick leaves rounding behind, and so may the border of slip
    void set_slip(State& to) const {
        const ActiveSet<Scalar>& solver = to.solver_;
        to.slip_ = solver.signs().cwiseProduct(solver.signs().cwiseProduct(solver.slip()).cwiseMax(Scalar(0)));
    }
    Scalar work(const State& to) const { return -widths_.cwiseProduct(to.solver_.traction()).dot(to.slip_); }

    Scalar tangent(const Gain& gain, State& to) const {
        if (to.tangent_revision_ != to.solver_.revision()) {
            to.solver_.respond(VectorX<Scalar>::Ones(size()), to.response_);
            to.unit_tangent_ = widths_.dot(to.response_);
            to.solver_.respond(to.carried_, to.response_);
            to.carried_tangent_ = widths_.dot(to.response_);
            to.tangent_revision_ = to.solver_.revision();
        }
        return gain.last * to.unit_tangent_ + gain.first * to.carried_tangent_;
    }

    Scalar half_length_, width_, shear_modulus_;  // a [m], 2b [m], G [Pa]
    VectorX<Scalar> widths_, bound_;
    std::shared_ptr<const int> mark_ = std::make_shared<const int>(0);
};

}  // namespace detail

}  // namespace rollbem
