// Traction and slip along the contact, for --tractions and for the picture of the creep curve.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <rollbem/discretisation/mesh.hpp>

#include "pressure.hpp"
#include "support/csv.hpp"
#include "support/scenes.hpp"

namespace friction {

/// Creepage ratios of a row.
struct CreepPoint {
    double longitudinal;
    std::optional<double> lateral{};  ///< nothing with creepage in one direction only
    double spin = 0;                  ///< times a
};

/// The distributions behind one row of the steady table.
struct Profile {
    const study::Scene* scene;
    std::string mesh_name;
    std::optional<double> alpha_L, alpha_T;
    CreepPoint point;
    std::string status;
    rollbem::Mesh<double> mesh;
    Eigen::VectorXd traction, bound, slip;  ///< of every element [mu p0, mu p0, V mu p0/G]
    std::vector<bool> sticks{};
    Eigen::VectorXd lateral_traction{}, lateral_slip{};  ///< empty in one direction
    Eigen::VectorXd friction{};                          ///< mu/mu_0; empty where it is constant
};

/// Profiles in the order of the rows, from any thread.
class Profiles {
public:
    void keep(std::size_t task, std::size_t row, Profile profile) {
        const std::lock_guard lock(mutex_);
        profiles_.insert_or_assign({task, row}, std::move(profile));
    }
    const std::map<std::pair<std::size_t, std::size_t>, Profile>& all() const { return profiles_; }

private:
    std::mutex mutex_;
    std::map<std::pair<std::size_t, std::size_t>, Profile> profiles_;
};

}  // namespace friction
