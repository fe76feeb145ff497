// The eigenvalues of the plane model in closed form, to which --spectrum compares computed ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include <rollbem/reference/bessel.hpp>
#include <rollbem/scene/contact.hpp>

#include "support/non_steady.hpp"

namespace stability {

/// Closed-form eigenvalues. There are infinitely many, about pi apart; these are the ones in the range of given ones.
class ExactSpectrum {
public:
    ExactSpectrum(const rollbem::Contact<double>& contact, const std::vector<std::complex<double>>& computed) {
        double largest = 0;
        for (const std::complex<double>& nu : computed) {
            if (reaches(nu)) largest = std::max(largest, std::abs(nu));
        }
        if (!study::plane_model_decays(contact)) return;
        values_ = rollbem::reference::eigenvalues(static_cast<std::size_t>(largest / std::numbers::pi) + 8,
                                                  contact.poisson_ratio(), contact.aspect());
    }

    std::optional<std::complex<double>> nearest(std::complex<double> nu) const {
        if (values_.empty() || !reaches(nu)) return std::nullopt;
        const std::complex<double> above(nu.real(), std::abs(nu.imag()));
        const auto nearer = [&](std::complex<double> left, std::complex<double> right) {
            return std::abs(left - above) < std::abs(right - above);
        };
        const std::complex<double> found = *std::min_element(values_.begin(), values_.end(), nearer);
        return nu.imag() < 0 ? std::conj(found) : found;
    }

    const std::vector<std::complex<double>>& upper_half() const { return values_; }  ///< Im >= 0, by ascending modulus

private:
    // far beyond what any mesh resolves; keeps the list short
    static bool reaches(const std::complex<double>& nu) { return std::abs(nu) <= 3e4; }

    std::vector<std::complex<double>> values_;
};

}  // namespace stability
