// The schemes that precision_study compares, by name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene.hpp"

namespace precision {

/// The names of all schemes, in the order of the rows.
const std::vector<std::string>& scheme_names();

/// One scheme at one size n (elements, on the finer mesh where two are extrapolated; Chebyshev states; order of the
/// polynomial; 0 for the closed form). Keeps a copy of the scene.
class Case {
public:
    Case(const Scene& scene, std::string scheme, long n);

    const std::string& scheme() const { return scheme_; }
    long n() const { return n_; }

    /// Whether the scheme exists at this size.
    static bool exists(const std::string& scheme, long n);
    /// Whether the scheme can compute the quantity.
    static bool has(const std::string& scheme, const Quantity& quantity);

    /// relative_error as the study defines it; empty if there is no trustworthy result.
    std::optional<double> relative_error(const Quantity& quantity) const;
    /// Why there is no trustworthy result, by the library's names.
    std::string status(const Quantity& quantity) const;
    /// kernel, aspect, poisson, and size_ratio and epsilon if the scheme's mesh has them.
    std::vector<std::string> setting() const;
    /// Computes everything from the mesh to the result; the value depends on the result.
    double run(const Quantity& quantity) const;
    /// Whether no eigenvalue of G' p = nu G p grows, as computed; empty if the eigenvalues were not found.
    std::optional<bool> stable() const;

private:
    /// Not of the traction.
    Values values(const Quantity& quantity) const;
    double traction_error() const;

    Scene scene_;
    std::string scheme_;
    long n_;
};

}  // namespace precision
