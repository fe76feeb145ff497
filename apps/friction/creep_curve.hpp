// The rows of a creep curve, whichever way they are computed: by elements in one direction or in both, or with the
// exact border of stick.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/status.hpp>

#include "falling.hpp"
#include "pressure.hpp"
#include "profiles.hpp"
#include "support/csv.hpp"
#include "support/scenes.hpp"
#include "support/table.hpp"

namespace friction {

/// Forces of the sweep that the rows do not show, for the picture: points of ratio and force for each scene.
class OtherBranch {
public:
    void keep(std::size_t task, std::vector<std::pair<double, double>> points) {
        const std::lock_guard lock(mutex_);
        points_.insert_or_assign(task, std::move(points));
    }
    const std::map<std::size_t, std::vector<std::pair<double, double>>>& all() const { return points_; }

private:
    std::mutex mutex_;
    std::map<std::size_t, std::vector<std::pair<double, double>>> points_;
};

/// What all rows need.
struct CreepCurve {
    const study::Options& options;
    const Pressure& pressure;
    std::vector<CreepPoint> points;
    double layer;
    std::optional<FallingLaw> falling{};  ///< nothing where mu is constant
    std::string sweep{};                  ///< up or down: each point starts from its neighbour; empty: from scratch
    Profiles* profiles = nullptr;         ///< null where none are wanted
    OtherBranch* other = nullptr;         ///< null without a sweep that is drawn

    bool timed() const;
    bool carter() const { return pressure.hertz && layer == 0 && !falling; }  ///< whether his closed form holds

    /// Force ratios where there is a closed form: Carter's, along the creepage where nu = 0, and in either direction
    /// alone.
    struct Exact {
        std::optional<double> longitudinal{}, lateral{};
    };
    Exact exact(const study::Scene& scene, const CreepPoint& point) const;
};

/// What was found at a point, in the units of the columns. Forces and what follows from them are not a number where
/// there is no solution.
struct CreepResult {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();

    std::string mesh_name;
    std::optional<double> alpha_L, alpha_T;
    double force_ratio = none, tangent_ratio = none, slip_work = none, complementarity_residual = none;
    std::optional<double> lateral_force_ratio{}, lateral_tangent_ratio{}, moment_ratio{};
    std::ptrdiff_t stick_count = 0;
    int rounds = 0;
    std::optional<int> pivots{};
    study::Cell time_us{}, assembly_us{};
    std::string status{};
};

std::vector<std::string> creep_columns();
std::string creep_help();  ///< their meanings

study::Row creep_row(const CreepCurve& curve, const study::Scene& scene, const CreepPoint& point,
                     const CreepResult& result);

/// Emits the rows of `range`, which do not depend on the rows before: each is solved from scratch, or in a sweep after
/// its neighbours.
using CreepRows = void(const CreepCurve& curve, const study::Scene& scene, std::size_t task, study::RowRange range,
                       const study::Emit& emit);
CreepRows element_rows, border_rows;

/// The same without results, where G' is not finite, as for b/a or a layer near the limits of double.
CreepRows rows_without;

/// One row per element of every profile, and the companion file.
std::string profile_header();
void write_profiles(const Profiles& profiles, const CreepCurve& curve, study::TableFile& file);

}  // namespace friction
