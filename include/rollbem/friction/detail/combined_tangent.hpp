// How the tractions of a stage that has been solved in two directions follow a change: of a creepage, of the load, of
// the half-length, and of what an earlier stage has left.
#pragma once

#include "../../detail/language.hpp"

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "../../assembly/rolling_system.hpp"
#include "../../types.hpp"
#include "../combined_state.hpp"
#include "combined_memory.hpp"
#include "rolling_stage.hpp"

namespace rollbem::detail {

/// What tangents are taken by: the place of each in CombinedMemory::carried.
enum class Parameter : unsigned char { longitudinal, lateral, load, half_length };

template <class Scalar>
using SystemPair = std::array<ElementSystem<Scalar>, 2>;

/// Derivatives of the stage that memory.solver has solved last; each leaves dp in memory.response. `before` is d of the
/// displacement that the stage starts from.
template <class Scalar>
class CombinedTangent {
public:
    using Vectors = ElementVectors<Scalar>;

    CombinedTangent(CombinedMemory<Scalar>& memory, const Vectors* before) : memory_(memory) {
        if (before) {
            memory.right = -*before;
        } else {
            memory.right.setZero();
        }
    }

    /// By a creepage, of which part dq xi depends by `imposed`.
    void by_creepage(Parameter direction, Scalar imposed) {
        memory_.right.col(direction == Parameter::longitudinal ? 0 : 1).array() += imposed;
        memory_.solver.respond(memory_.right, memory_.response);
    }

    /// By the load, on which the bounds depend by memory.bound_rate: what slips follows its bound.
    void by_load(const VectorX<Scalar>& bound_rate) {
        const Vectors& direction = memory_.solver.direction();
        for (std::size_t d = 0; d < 2; ++d) {
            memory_.column = bound_rate.cwiseProduct(direction.col(column(d)));
            memory_.right.col(column(d)).noalias() += memory_.solver.matrix(d) * memory_.column;
        }
        memory_.solver.respond(memory_.right, memory_.response);
        for (Eigen::Index d = 0; d < 2; ++d) memory_.response.col(d) += bound_rate.cwiseProduct(direction.col(d));
    }

    /// By the half-length at the end of the step, of whose change the stage sees `share` of its length and `growth` of
    /// its growth.
    void by_half_length(const SystemPair<Scalar>& systems, Scalar share, Scalar growth) {
        for (std::size_t d = 0; d < 2; ++d) {
            add_displacement_rate(systems[d], d, share, memory_.right);
            memory_.product.noalias() = systems[d].G_prime() * memory_.column;
            memory_.right.col(column(d)).array() -= growth * *systems[d].points() * memory_.product.array();
        }
        memory_.solver.respond(memory_.right, memory_.response);
    }

    /// d of the displacement at the end of the stage, `share` of da besides where it is by the half-length.
    static void carry(const SystemPair<Scalar>& systems, Scalar share, CombinedMemory<Scalar>& memory,
                      Vectors& carried) {
        CombinedTangent tangent(memory, nullptr);
        for (std::size_t d = 0; d < 2; ++d) {
            memory.column = memory.response.col(column(d));
            find_displacement(systems[d], memory.stage.half_length, memory.column, memory.product);
            carried.col(column(d)) = memory.product;
            if (share != 0) tangent.add_displacement_rate(systems[d], d, share, carried);
        }
    }

private:
    static Eigen::Index column(std::size_t direction) { return static_cast<Eigen::Index>(direction); }

    // Adds share dU/da; leaves the tractions of the direction in memory.column.
    void add_displacement_rate(const ElementSystem<Scalar>& system, std::size_t d, Scalar share, Vectors& sum) {
        memory_.column = memory_.solver.traction().col(column(d));
        find_displacement(system, memory_.stage.half_length, memory_.column, memory_.product);
        find_displacement_rate(system, memory_.stage.half_length, memory_.column, memory_.product, memory_.rate);
        sum.col(column(d)) += share * memory_.rate;
    }

    CombinedMemory<Scalar>& memory_;
};

}  // namespace rollbem::detail
