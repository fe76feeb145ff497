// Frictional heat of each element, from slip at the collocation points and tractions on the elements.
#pragma once

#include <Eigen/Core>

#include "../../system/detail/centre_values.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"
#include "roles.hpp"

namespace rollbem::detail {

/// Work of tractions against slip, element by element, with the slip interpolated to the element's centre
/// (CentreValues). At alpha = 0.5 on a line, where the collocation point of an element is its leading edge, this is the
/// mean of the slips at its two edges. The slip of the element's own equation would give an error of first order.
///
/// Where slip is rotated, tractions oppose the slip at the centre, so that slipping elements never gain energy. A
/// sticking element ahead of a slipping one contributes -p_i . s_(i-1)/2, of either sign; without this term the sum is
/// wrong.
///
/// Lengths in units of a, tractions in G. The works of two directions add up in the same sum.
class SlipWork {
public:
    /// In strips on a patch the slip of each element's own equation is used unless slip is rotated.
    SlipWork(const Elements<double>& elements, bool turned)
        : widths_(elements.areas),
          centres_(turned ? CentreValues<double>::in_strips(elements.behind)
                          : CentreValues<double>::in_one_strip(
                                widths_, elements.is_one_strip() ? elements.x : ArrayX<double>())),
          turned_(turned) {}

    const CentreValues<double>& centres() const { return centres_; }

    /// Adds -p s dx of each element to `work`. The widths dx grow with the contact: `half_length` is the present
    /// half-length over the reference one, on a patch times the same ratio of the half-widths.
    void add(const Eigen::Ref<const VectorX<double>>& traction, const Eigen::Ref<const VectorX<double>>& slip,
             VectorX<double>& work, double half_length = 1) const {
        using Some = Eigen::Array<double, together, 1>;
        const auto some = [](const double* first) { return Eigen::Map<const Some>(first); };
        const ArrayX<double>& shares = centres_.shares();
        const Index n = widths_.size();
        Index i = 0;
        for (; i < n - shares.size() / together * together; ++i) {
            work[i] -= half_length * widths_[i] * traction[i] * centres_.at(i, slip);
        }
        for (; i < n; i += together) {
            const Some behind = some(slip.data() + i - 1), ahead = some(slip.data() + i);
            Eigen::Map<Some>(&work[i]) -= half_length * some(&widths_[i]) * some(traction.data() + i) *
                                          (behind + some(&shares[i - 1]) * (ahead - behind));
        }
    }

    /// Sum of p u dx over all elements and directions; twice the elastic energy for the displacements of p.
    template <class Traction, class Displacement>
    double product(const Traction& traction, const Displacement& displacement) const {
        double sum = 0;
        for (Index d = 0; d < traction.cols(); ++d) {
            for (Index i = 0; i < widths_.size(); ++i) {
                sum += widths_[i] * traction(i, d) * centres_.at(i, displacement.col(d));
            }
        }
        return sum;
    }

    /// Completes a sum: multiplies it by `unit` and, unless slip is rotated, removes negative values. No element gains
    /// energy, but interpolation may yield a gain of second order where the slip changes sign or vanishes within an
    /// element.
    void end(VectorX<double>& work, double unit = 1) const {
        if (turned_) {
            work *= unit;
        } else {
            work = unit * work.cwiseMax(0.0);
        }
    }

private:
    static constexpr Index together = 4;

    ArrayX<double> widths_;
    CentreValues<double> centres_;
    bool turned_;
};

}  // namespace rollbem::detail
