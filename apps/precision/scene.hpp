// The quantities that precision_study compares schemes by, and the contact they are applied to.
#pragma once

#include <complex>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <rollbem/scene/contact.hpp>

namespace precision {

/// A problem is computed, and timed, as a whole.
enum class Problem { steady, harmonic, step, friction, combined_friction, varying_load };

/// Whether the problem has Coulomb's law, for which only elements are available.
inline bool has_friction(Problem problem) {
    return problem == Problem::friction || problem == Problem::combined_friction || problem == Problem::varying_load;
}

struct Quantity {
    std::string name;
    Problem problem;
    double frequency = 0;  ///< omega a/V, harmonic problems
};

/// All quantities in the order of the rows: c11, traction, c11 at three frequencies, step_force, friction_force,
/// combined_force, load_force.
const std::vector<Quantity>& quantities();

/// Numbers that a quantity consists of; all but c11 under harmonic creepage are real.
using Values = std::vector<std::complex<double>>;

/// What the schemes are applied to, and the parameters of the graded meshes.
struct Scene {
    rollbem::Contact<double> contact;  ///< a = G = 1
    bool plane;                        ///< plane or strip kernel
    double size_ratio, epsilon;        ///< of the geometric and the Knothe mesh
    /// See reference(), of all quantities but the traction. Copies of a scene share them: they are computed last.
    std::shared_ptr<std::map<std::string, Values>> references = std::make_shared<std::map<std::string, Values>>();
};

}  // namespace precision
