// One step in full adhesion by the stages of its integrator, of a contact whose semi-axes may change during the step.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <Eigen/Core>

#include "../../rolling/detail/stage_equations.hpp"
#include "../../rolling/detail/time_step.hpp"
#include "../../scene/detail/directions.hpp"
#include "../../types.hpp"
#include "stage_factors.hpp"

namespace rollbem::detail {

/// A view of a vector of unknowns with one column for each direction; the longitudinal unknowns come first.
template <int columns, class Unknowns>
auto in_columns(const Unknowns& unknowns) {
    using Columns = Eigen::Matrix<typename Unknowns::Scalar, Eigen::Dynamic, columns>;
    return Eigen::Map<const Columns>(unknowns.data(), unknowns.rows() / columns, columns);
}
template <int columns, class Unknowns>
auto in_columns(Unknowns&& unknowns) requires(!std::is_const_v<std::remove_reference_t<Unknowns>>) {
    using Columns = Eigen::Matrix<typename std::remove_reference_t<Unknowns>::Scalar, Eigen::Dynamic, columns>;
    return Eigen::Map<Columns>(unknowns.data(), unknowns.rows() / columns, columns);
}

/// What the stages of a step in full adhesion are solved from, besides the step: references to values of the caller,
/// made on the stack for one step. Stages of one `model` have the same matrices.
template <int directions>
struct AdhesionProblem {
    std::uint64_t model;
    const VectorX<double>& old;  ///< the unknowns from which the step starts
    const RigidSlip<directions>& slip;
    StageFactors& factors;
    /// Parameters of the wanted tangents.
    std::array<bool, Parameters<directions>::count> asked{true, directions == 2, directions == 2};
};

/// Solves a step by the stages of a StageTable. Lengths are in units of a_0, the half-length for which the system was
/// made; everything else is in the unit of the unknowns y.
///
/// With dU/dq = (1 + a' zeta) du/dx - inputs v on a line, and U = M(a) y, each stage, of the part g of the step, is
///
///     M(a_k) y_k - g (dq + da zeta) G' y_k = U_old + carried - g inputs v dq,    carried = ratio (U_1 - U_old)
///
/// with ratio = (1-g)/g, where `carried` occurs in the last of two stages. It is solved for y_k - y_old, so that short
/// steps keep their digits.
template <int directions>
class AdhesionStages {
public:
    using Vector = VectorX<double>;
    using By = Parameters<directions>;
    using Step = TimeStep<directions>;
    using Problem = AdhesionProblem<directions>;

    explicit AdhesionStages(Eigen::Index n)
        : change_(Vector::Zero(n)),
          carried_(change_),
          start_(change_),
          growth_(change_),
          scratch_(change_),
          now_(change_) {
        response_.fill(change_);
        carried_response_.fill(change_);
    }

    /// Solves all stages; with(geometry, use) must call use(equations) with the equations of a stage.
    template <class With>
    void solve(const Step& step, const Problem& problem, const With& with) {
        carried_.setZero();
        for (Vector& carried : carried_response_) carried.setZero();
        for (int number = 1; number <= step.stage_count(); ++number) {
            const Stage now = step.stage(number);
            with(now.geometry, [&](const auto& equations) {
                prepare(problem, equations);
                find_change(step, now, problem, equations);
                find_responses(now, problem, equations);
                if (!now.place.is_last()) carry(step, now, problem, equations);
            });
        }
    }

    /// Finds the unknowns per unit of each creepage in steady rolling of a patch, as responses.
    void solve_steady(std::uint64_t model, const ShapeEquations& equations, const RigidSlip<directions>& slip,
                      StageFactors& factors) {
        factors.prepare(model, equations.stage, [&](MatrixX<double>& M) {
            fill<2>(M, equations, [&](auto d, auto e, auto&& block) { equations.fill_slope(1, d, e, block); });
        });
        for (std::size_t j = 0; j < By::creepages; ++j) {
            response_[j].setZero();
            slip.add(j, 1.0, equations.stage.axes(), response_[j]);
            factors.solve(response_[j]);
        }
    }

    const Vector& change() const { return change_; }  ///< change of the unknowns in the step
    /// Derivative of the unknowns with respect to a parameter (Parameters) at the end of the step; semi-axes are over
    /// the contact's semi-axes.
    const Vector& response(std::size_t parameter) const { return response_[parameter]; }

private:
    using Stage = detail::Stage<directions>;

    template <class Equations>
    static constexpr int columns = std::remove_cvref_t<Equations>::columns;

    template <class Equations>
    void prepare(const Problem& problem, const Equations& equations) {
        problem.factors.prepare(problem.model, equations.stage, [&](MatrixX<double>& M) {
            fill<columns<Equations>>(M, equations, [&](auto d, auto e, auto&& block) { equations.fill(d, e, block); });
        });
    }
    template <class Equations>
    void find_change(const Step& step, const Stage& now, const Problem& problem, const Equations& equations) {
        const auto in = [](auto&& unknowns) { return in_columns<columns<Equations>>(unknowns); };
        change_ = carried_;
        equations.add_travel(in(problem.old), in(scratch_), in(change_));
        if (step.varies()) {
            if (!now.place.is_second) equations.find_start(step.start, in(problem.old), in(start_));
            equations.find_growth(step.start, in(problem.old), in(start_), in(growth_));
            change_ -= growth_;
        }
        scratch_.setZero();
        now.add_motion(problem.slip, scratch_);
        change_ -= scratch_;
        problem.factors.solve(change_);
    }
    template <class Equations>
    void find_responses(const Stage& now, const Problem& problem, const Equations& equations) {
        const auto in = [](auto&& unknowns) { return in_columns<columns<Equations>>(unknowns); };
        now_ = problem.old + change_;
        for (std::size_t j = 0; j < By::count; ++j) {
            if (!problem.asked[j]) continue;
            response_[j] = carried_response_[j];
            now.add_rate(j, problem.slip, equations, in(now_), in(scratch_), in(response_[j]));
            problem.factors.solve(response_[j]);
            response_[j] = -response_[j];
        }
    }
    // Keeps the quantities of the first of two stages from which the second one starts.
    template <class Equations>
    void carry(const Step& step, const Stage& now, const Problem& problem, const Equations& equations) {
        const auto in = [](auto&& unknowns) { return in_columns<columns<Equations>>(unknowns); };
        equations.find_displacements(in(change_), in(carried_));
        if (step.varies()) carried_ += growth_;
        carried_ *= now.place.ratio();
        for (std::size_t j = 0; j < By::count; ++j) {
            if (!problem.asked[j]) continue;
            now.find_carried(j, equations, in(now_), in(response_[j]), in(scratch_), in(carried_response_[j]));
        }
    }

    // Fills the matrix of all unknowns by fill_block(d, e, block).
    template <int columns_of_unknowns, class Equations, class FillBlock>
    static void fill(MatrixX<double>& M, [[maybe_unused]] const Equations& equations, const FillBlock& fill_block) {
        if constexpr (columns_of_unknowns == 1) {
            fill_block(std::size_t(0), std::size_t(0), M);
        } else {
            const Eigen::Index n = M.rows() / 2;
            for (std::size_t d = 0; d < 2; ++d) {
                for (std::size_t e = 0; e < 2; ++e) {
                    auto block = M.block(static_cast<Eigen::Index>(d) * n, static_cast<Eigen::Index>(e) * n, n, n);
                    if (d == e || equations.coupled()) {
                        fill_block(d, e, block);
                    } else {
                        block.setZero();
                    }
                }
            }
        }
    }

    Vector change_, carried_, start_, growth_, scratch_, now_;
    std::array<Vector, By::count> response_, carried_response_;
};

}  // namespace rollbem::detail
