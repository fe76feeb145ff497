// Hertz's line contact under a varying load: half-length and pressures of the elements for each load, on a mesh that
// breathes with the contact, or on a fixed mesh on which the contact grows and shrinks.
#pragma once

#include "../detail/decl.hpp"

#include <optional>

#include "../discretisation/mesh.hpp"
#include "../status.hpp"
#include "../types.hpp"
#include "hertz.hpp"
#include "load.hpp"

namespace rollbem {

/// Makes the NormalLoad of a load per width P [N/m], for two cylinders with the radius and moduli of a HertzLine.
///
///     const HertzLoad hertz = HertzLoad::breathing(line, mesh);
///     NormalLoad load = hertz.at(line.load_per_width());
///     hertz.set(load_per_width, load);                                   // no allocation
///     const auto step = model.advance(now, {dq, motion, load}, next, workspace);
///     const auto by_load =
///         step.tangent_by_load + hertz.half_length_rate(load_per_width) * step.tangent_by_half_length;
class HertzLoad {
public:
    /// The mesh follows the contact: half-length a(P), the shape of the pressures constant.
    static HertzLoad breathing(const HertzLine& line, const Mesh<double>& mesh) {
        return HertzLoad(line, mesh, std::nullopt);
    }

    /// The mesh covers -half_length ... half_length [m], with the contact in its middle. Elements at the edges of the
    /// contact may be partly covered; each carries its exact mean pressure. Throws std::invalid_argument unless
    /// 0 < half_length < inf.
    static HertzLoad fixed(const HertzLine& line, const Mesh<double>& mesh, double half_length);

    bool breathes() const { return !fixed_; }

    /// a [m] of the contact under P [N/m] >= 0.
    double half_length(double load_per_width) const;

    /// d NormalLoad::half_length / dP [m^2/N]: da/dP if the mesh breathes, 0 if it is fixed.
    double half_length_rate(double load_per_width) const;

    /// Sets pressures, their derivatives with respect to P, and the half-length of the mesh. A fixed mesh without load,
    /// P = 0, has no pressure. The status is invalid_load, which a step under the resulting `load` also returns, if P
    /// is negative or not finite, if a fixed mesh does not cover the contact, or if P = 0 on a mesh that breathes: it
    /// would have no length.
    Status set(double load_per_width, NormalLoad& load) const noexcept;

    /// A new load, which set() can overwrite. Throws std::invalid_argument if the status of set() is not ok.
    NormalLoad at(double load_per_width) const;

private:
    HertzLoad(const HertzLine& line, const Mesh<double>& mesh, const std::optional<double>& half_length)
        : line_(line), mesh_(mesh), mean_(mean_hertz_pressure(mesh)), fixed_(half_length) {}

    Eigen::Index size() const { return mesh_.size(); }

    // Sets the load of a contact of half-length a on a fixed mesh. At constant x, dp_n/dP = 1/(pi sqrt(a^2 - x^2)).
    void cover(double load_per_width, double a, NormalLoad& load) const noexcept;

    HertzLine line_;
    Mesh<double> mesh_;
    ArrayX<double> mean_;
    std::optional<double> fixed_;  // half-length of a fixed mesh [m]
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/hertz_load.ipp"
#endif
