// Response of a contact patch to harmonic creepages and spin, at many frequencies.
#pragma once

#include <algorithm>
#include <complex>
#include <utility>
#include <vector>

#include "../assembly/patch_system.hpp"
#include "../scene/patch_contact.hpp"
#include "../status.hpp"
#include "../types.hpp"
#include "frequency.hpp"
#include "patch_steady.hpp"

namespace rollbem {

/// One point of a sweep.
template <class Scalar>
struct PatchSweepPoint : CreepCoefficients<std::complex<Scalar>> {
    MatrixX<std::complex<Scalar>> coefficients;  ///< 3 x 3, as in PatchSteadySolution
    Scalar residual = 0, rcond = 1;              ///< as in SweepPoint: the worse of the patch's parts
    Status status = Status::ok;
};

/// Creep coefficients at many frequencies: a FrequencySweep for each part of the patch. Const objects may be shared by
/// threads.
template <class Scalar_>
class PatchFrequencySweep {
public:
    using Scalar = Scalar_;

    /// `parts` as patch_parts makes them, in units of the contact's a.
    PatchFrequencySweep(PatchContact<Scalar> contact, const std::vector<PatchPart<Scalar>>& parts)
        : contact_(std::move(contact)) {
        for (const PatchPart<Scalar>& part : parts) parts_.push_back({FrequencySweep<Scalar>(part.system), part.first});
    }

    /// At z = omega a/V (outlines: omega c/V), of either sign. Throws std::invalid_argument if z is not finite.
    PatchSweepPoint<Scalar> operator()(Scalar z) const {
        PatchSweepPoint<Scalar> point;
        point.coefficients = MatrixX<std::complex<Scalar>>::Zero(3, 3);
        for (const Part& part : parts_) {
            const SweepPoint<Scalar> own = part.sweep(z);
            const Eigen::Index count = own.coefficients.cols();
            point.coefficients.block(part.first, part.first, count, count) = own.coefficients;
            point.residual = (std::max)(point.residual, own.residual);
            point.rcond = (std::min)(point.rcond, own.rcond);
            if (point.status == Status::ok) point.status = own.status;
        }
        static_cast<CreepCoefficients<std::complex<Scalar>>&>(point) = creep_coefficients(contact_, point.coefficients);
        return point;
    }

private:
    struct Part {
        FrequencySweep<Scalar> sweep;
        Eigen::Index first;
    };

    PatchContact<Scalar> contact_;
    std::vector<Part> parts_;
};

}  // namespace rollbem
