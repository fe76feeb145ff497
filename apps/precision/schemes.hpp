// The schemes that precision_study compares, the quantities it compares them by, and what computes one with the other.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/scene/contact.hpp>

namespace precision {

/// What is computed in one go, and timed.
enum class Problem { steady, harmonic, step, friction, combined_friction, varying_load };

/// Whether it is one with Coulomb's law, which only elements solve.
inline bool has_friction(Problem problem) {
    return problem == Problem::friction || problem == Problem::combined_friction || problem == Problem::varying_load;
}

struct Quantity {
    std::string name;
    Problem problem;
    double frequency = 0;  ///< omega a/V, harmonic problems
};

/// c11, traction, c11 at three frequencies, step_force, friction_force, combined_force, load_force: all in the order of
/// the rows.
const std::vector<Quantity>& quantities();

/// The names of all schemes, in the order of the rows.
const std::vector<std::string>& scheme_names();

/// What the schemes are applied to, and the parameters of the graded meshes.
struct Scene {
    rollbem::Contact<double> contact;   ///< a = G = 1
    bool plane;                         ///< plane or strip kernel
    double size_ratio, epsilon;         ///< of the geometric and the Knothe mesh
    std::vector<double> step_forces{};  ///< exact, see exact_step_forces(); only for Problem::step
    std::vector<double> both_forces{};  ///< of Problem::combined_friction, see combined_reference()
    std::vector<double> load_forces{};  ///< of Problem::varying_load, see load_reference()
};

/// -F/(a G xi) of the plane model at q/a = 1, 2, ... 10 after a step of creepage.
std::vector<double> exact_step_forces(const rollbem::Contact<double>& contact);

/// -F/(mu N) in both directions at a creepage ratio of 0.5 under 45 degrees, of the plane model: nothing is known in
/// closed form, so that it is extrapolated from cosine meshes of 320 and 640 elements. From 640 and 1280 it is another
/// by 7e-6 of itself.
std::vector<double> combined_reference(const rollbem::Contact<double>& contact);

/// -F/(mu N_0) of the plane model after each step over a period of a load that varies by half, at a creepage ratio of
/// 0.5 from steady rolling: extrapolated from cosine meshes of 160 and 320 elements that breathe, in steps of a quarter
/// of those of the schemes. From 320 and 640 in steps of half of that it is another by at most 4e-6.
std::vector<double> load_reference(const rollbem::Contact<double>& contact);

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
    /// Why there is no trustworthy result, by the library's names.
    std::string status(const Quantity& quantity) const;
    /// kernel, aspect, poisson, and size_ratio and epsilon where the scheme's mesh has them.
    std::vector<std::string> setting() const;
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
