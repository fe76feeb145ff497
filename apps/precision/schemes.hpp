// The schemes that precision_study compares, the quantities it compares them by, and what computes one with the other.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/scene/contact.hpp>

namespace precision {

/// What is computed in one go, and timed.
enum class Problem { steady, harmonic, step, friction };

struct Quantity {
    std::string name;
    Problem problem;
    double frequency = 0;  ///< omega a/V, harmonic problems
};

/// c11, traction, c11 at three frequencies, step_force, friction_force: all in the order of the rows.
const std::vector<Quantity>& quantities();

/// The names of all schemes, in the order of the rows.
const std::vector<std::string>& scheme_names();

/// What the schemes are applied to, and the parameters of the graded meshes.
struct Scene {
    rollbem::Contact<double> contact;   ///< a = G = 1
    bool plane;                         ///< plane or strip kernel
    double size_ratio, epsilon;         ///< of the geometric and the Knothe mesh
    std::vector<double> step_forces{};  ///< exact, see exact_step_forces(); only for Problem::step
};

/// -F/(a G xi) of the plane model at q/a = 1, 2, ... 10 after a step of creepage.
std::vector<double> exact_step_forces(const rollbem::Contact<double>& contact);

/// One scheme at one size n (elements, on the finer mesh where two are extrapolated; Chebyshev states; order of the
/// polynomial; 0 for the closed form). Keeps a copy of the scene.
class Case {
public:
    Case(const Scene& scene, std::string scheme, long n);

    const std::string& scheme() const { return scheme_; }
    long n() const { return n_; }

    /// Whether the scheme exists at this size.
    static bool exists(const std::string& scheme, long n);
    /// Whether the scheme has the quantity.
    static bool has(const std::string& scheme, const Quantity& quantity);

    /// relative_error as the study defines it; empty where there is no trustworthy result.
    std::optional<double> relative_error(const Quantity& quantity) const;
    /// Everything from the mesh to the result; the value depends on what was computed.
    double run(const Quantity& quantity) const;
    /// Whether no eigenvalue of G' p = nu G p grows, as computed; empty where the eigenvalues are not to be had.
    std::optional<bool> stable() const;

private:
    Scene scene_;
    std::string scheme_;
    long n_;
};

/// What the kernel of the scene changes in a quantity against the plane limit: the model's error, on one mesh.
double model_error(const Scene& scene, const Quantity& quantity);

}  // namespace precision
