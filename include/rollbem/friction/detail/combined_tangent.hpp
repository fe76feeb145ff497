// Derivatives of the tractions of a solved stage in two directions by a creepage, the load or the half-length,
// including the contribution of an earlier stage.
#pragma once

#include "../../detail/language.hpp"

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "../../assembly/rolling_system.hpp"
#include "../../types.hpp"
#include "../combined_state.hpp"
#include "combined_memory.hpp"
#include "load_tangents.hpp"
#include "rolling_stage.hpp"

namespace rollbem::detail {

/// What derivatives are taken by; its index in CombinedMemory::carried.
enum class Parameter : unsigned char { longitudinal, lateral, load, half_length };

template <class Scalar>
using SystemPair = std::array<ElementSystem<Scalar>, 2>;

/// Derivatives by one parameter of the stage that `stages` have solved last in memory.solver. Each leaves dp in
/// memory.response.
template <class Scalar, class Stages>
class CombinedTangent {
public:
    /// `carried`: memory.carried of an earlier stage shifts the equations.
    CombinedTangent(Stages& stages, CombinedMemory<Scalar>& memory, Parameter parameter, bool carried)
        : stages_(stages), memory_(memory), parameter_(parameter) {
        if (carried) {
            memory.right = memory.carried[place(parameter)];
        } else {
            memory.right.setZero();
        }
    }

    /// By a creepage, with d(part dq xi)/d creepage = `imposed`.
    void by_creepage(Scalar imposed) {
        memory_.right.col(parameter_ == Parameter::longitudinal ? 0 : 1).array() += imposed;
        respond();
    }

    /// By the load: bounds change by `progress` times memory.bound_rate, and slipping elements follow theirs.
    void by_load(Scalar progress) { respond(&memory_.bound_rate, progress); }

    /// By the half-length at the end of the step, in a_0: dM p = progress dU/da - part zeta G' p.
    void by_half_length(const SystemPair<Scalar>& systems, const StagePlace<Scalar>& stage) {
        for (std::size_t d = 0; d < 2; ++d) {
            add_displacement_rate(systems[d], d, stage.progress, memory_.right);
            memory_.product.noalias() = systems[d].G_prime() * memory_.column;
            memory_.right.col(column(d)).array() -= stage.part * *systems[d].points() * memory_.product.array();
        }
        respond();
    }

    /// For the second stage, which starts from U + ratio (U_1 - U): what dp of the first adds to its constants, with
    /// the direct effect of the half-length by `progress` if that is the parameter.
    void carry(const SystemPair<Scalar>& systems, Scalar ratio, Scalar progress) {
        ElementVectors<Scalar>& carried = memory_.carried[place(parameter_)];
        for (std::size_t d = 0; d < 2; ++d) {
            memory_.column = memory_.response.col(column(d));
            find_displacement(systems[d], memory_.stage.half_length, memory_.column, memory_.product);
            carried.col(column(d)) = memory_.product;
            if (parameter_ == Parameter::half_length) add_displacement_rate(systems[d], d, progress, carried);
        }
        carried *= -ratio;
        stages_.carry_response(place(parameter_));
    }

private:
    static Eigen::Index column(std::size_t direction) { return static_cast<Eigen::Index>(direction); }
    static std::size_t place(Parameter parameter) { return static_cast<std::size_t>(parameter); }

    void respond(const VectorX<Scalar>* bound_change = nullptr, Scalar share = 1) {
        stages_.respond(memory_.solver, memory_.right, 1, memory_.response, place(parameter_), bound_change, share);
    }

    // Adds progress dU/da; leaves the tractions of the direction in memory.column.
    void add_displacement_rate(const ElementSystem<Scalar>& system, std::size_t d, Scalar progress,
                               ElementVectors<Scalar>& sum) {
        memory_.column = memory_.solver.traction().col(column(d));
        find_displacement(system, memory_.stage.half_length, memory_.column, memory_.product);
        find_displacement_rate(system, memory_.stage.half_length, memory_.column, memory_.product, memory_.rate);
        sum.col(column(d)) += progress * memory_.rate;
    }

    Stages& stages_;
    CombinedMemory<Scalar>& memory_;
    Parameter parameter_;
};

}  // namespace rollbem::detail
