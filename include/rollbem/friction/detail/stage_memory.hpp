// The displacement at the start of a stage, on which its equations depend.
#pragma once

#include "../../detail/language.hpp"

#include <Eigen/Core>

#include "../../assembly/rolling_system.hpp"
#include "../../types.hpp"
#include "rolling_stage.hpp"

namespace rollbem::detail {

/// The displacement U at the start of a stage. It is stored as the tractions that cause it if the half-length is
/// constant (U is then linear in them), and directly otherwise. All memory is allocated by the constructor.
template <class Scalar>
class StageMemory {
public:
    explicit StageMemory(Eigen::Index n) : memory_(VectorX<Scalar>::Zero(n)), displacement_(memory_) {}

    /// Starts a step from tractions p/G at the half-length `from` in a_0; `grows` if the half-length changes in the
    /// step.
    template <class Derived>
    void begin(const RollingSystem<Scalar>& system, const Eigen::MatrixBase<Derived>& tractions, Scalar from,
               bool grows) {
        memory_ = tractions;
        half_length_ = from;
        grows_ = grows;
        if (!grows) return;
        find_displacement(system, from, memory_, displacement_);
        memory_.swap(displacement_);
    }

    /// Prepares the second stage: extrapolates by `ratio` from the start to the end of the first stage, which has these
    /// tractions and this half-length.
    void extrapolate(const RollingSystem<Scalar>& system, const VectorX<Scalar>& tractions, Scalar half_length,
                     Scalar ratio) {
        if (!grows_) {
            memory_ += ratio * (tractions - memory_);
            return;
        }
        find_displacement(system, half_length, tractions, displacement_);
        memory_ += ratio * (displacement_ - memory_);
    }

    /// c = imposed - U.
    void impose(const RollingSystem<Scalar>& system, Scalar imposed, VectorX<Scalar>& constant) const {
        if (grows_) {
            constant = memory_;
        } else {
            find_displacement(system, half_length_, memory_, constant);
        }
        constant = VectorX<Scalar>::Constant(constant.size(), imposed) - constant;
    }

private:
    VectorX<Scalar> memory_, displacement_;
    Scalar half_length_ = 1;
    bool grows_ = false;
};

}  // namespace rollbem::detail
