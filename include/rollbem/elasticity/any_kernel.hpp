// AnyKernel: the line kernel of a model that is chosen at run time, so that templates that take a kernel are compiled
// once.
#pragma once

#include <limits>
#include <optional>
#include <variant>

#include "../detail/finite.hpp"
#include "line_kernel.hpp"

namespace rollbem {

/// Models of a line contact.
enum class LineModel {
    strip,  ///< StripKernel; if b is infinite, its limit PlaneKernel
    plane,  ///< PlaneKernel
};

/// A StripKernel or a PlaneKernel, with all that both offer.
template <class Scalar_ = double>
class AnyKernel {
public:
    using Scalar = Scalar_;
    using Array = ArrayX<Scalar>;

    AnyKernel(const StripKernel<Scalar>& kernel) : kernel_(kernel) {}  // NOLINT: implicit
    AnyKernel(const PlaneKernel<Scalar>& kernel) : kernel_(kernel) {}  // NOLINT: implicit

    /// Those of a contact. Throw std::invalid_argument as the kernels do.
    static AnyKernel longitudinal(LineModel model, const Contact<Scalar>& contact) {
        if (is_strip(model, contact)) return StripKernel<Scalar>::longitudinal(contact);
        return PlaneKernel<Scalar>::longitudinal(contact);
    }
    static AnyKernel lateral(LineModel model, const Contact<Scalar>& contact) {
        if (is_strip(model, contact)) return StripKernel<Scalar>::lateral(contact);
        return PlaneKernel<Scalar>::lateral(contact);
    }

    LineModel model() const {
        return std::holds_alternative<PlaneKernel<Scalar>>(kernel_) ? LineModel::plane : LineModel::strip;
    }
    Scalar half_width() const {  ///< b in units of a
        return visit([](const auto& k) { return k.half_width(); });
    }
    /// Lambda of the plane; infinite for the strip, all of whose modes decay.
    Scalar lambda() const {
        const auto* plane = std::get_if<PlaneKernel<Scalar>>(&kernel_);
        return plane != nullptr ? plane->lambda() : std::numeric_limits<Scalar>::infinity();
    }

    Array g(const Array& x) const {
        return visit([&](const auto& k) { return k.g(x); });
    }
    Array H(const Array& x) const {
        return visit([&](const auto& k) { return k.H(x); });
    }
    Array H_integral(const Array& x) const {
        return visit([&](const auto& k) { return k.H_integral(x); });
    }
    std::optional<LogSplit<Scalar>> log_split(Scalar reach) const {
        return visit([&](const auto& k) { return k.log_split(reach); });
    }
    SmoothSplit<Scalar> smooth_split() const {
        return visit([](const auto& k) { return k.smooth_split(); });
    }
    Array smooth_part(const Array& x) const {
        return visit([&](const auto& k) { return k.smooth_part(x); });
    }
    Scalar smooth_slope(Scalar x) const {
        return visit([&](const auto& k) { return k.smooth_slope(x); });
    }
    /// Of the strip: the plane always has a log_split, which the assembly prefers.
    typename StripKernel<Scalar>::Coefficients taylor(const Array& x, Eigen::Index order) const {
        return std::get<StripKernel<Scalar>>(kernel_).taylor(x, order);
    }

private:
    static bool is_strip(LineModel model, const Contact<Scalar>& contact) {
        return model == LineModel::strip && detail::is_finite(contact.aspect());
    }
    auto visit(const auto& function) const { return std::visit(function, kernel_); }

    std::variant<StripKernel<Scalar>, PlaneKernel<Scalar>> kernel_;
};

}  // namespace rollbem
