// The input of profile_study, profiles, track, loads and positions, and its pictures.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/vehicle/wear.hpp>
#include <rollbem/vehicle/wheelset_forces.hpp>
#include <rollbem/vehicle/wheelset_on_track.hpp>

#include "support/csv.hpp"
#include "support/options.hpp"
#include "support/plot.hpp"
#include "support/table.hpp"

namespace profile {

using Side = rollbem::WheelsetOnTrack::Side;

struct Case {
    double shift, yaw;
    std::optional<double> roll, pitch_rate;
    double along = 0, pitch = 0;
    std::optional<double> height{};  ///< z_ws [m]; none: that which carries the load
    /// Of this position alone [N], [m/s], [-]; none: as of all.
    std::optional<double> load{}, speed{}, friction{};
    double distance = 0, passages = 0;  ///< rolled in this position [m], and by wheels over the rail [-]
    std::string label() const { return "shift = " + study::Cell(shift).text(4) + " m"; }
};
inline study::Cell scene_cell(const Case& at, const std::string& name) {
    return name == "shift" ? at.shift : name == "yaw" ? at.yaw : name == "pitch" ? at.pitch : at.along;
}

/// Wear of a wheel and its rail over all positions.
struct WearPlan {
    rollbem::ProfileWear::Law law;
    double step;                        ///< largest depth between two searches of contacts [m]
    std::string worn_wheel, worn_rail;  ///< files; empty where they are not asked for
    double cant, tape_offset;           ///< of the profiles as they are read [rad], [m]
    bool rail;                          ///< whether it wears, too
    std::size_t jobs;
};

/// Positions of a wheelset whose patches are found, and how.
struct Settings {
    std::vector<Case> cases;  ///< the shift outermost and the pitch rate innermost
    std::string columns;      ///< of a case, which name the quantities that are swept
    rollbem::WheelsetOnTrack wheelset;
    std::vector<Side> sides;
    double load;  ///< on each wheel [N], unless its height is given
    rollbem::WheelOnRail::Options grid;
    std::optional<rollbem::RollingFriction> friction;
    double speed;                       ///< V [m/s]
    double shear_yield;                 ///< [Pa]
    std::optional<double> force;        ///< of friction along x, in place of the pitch rate [N]
    bool loads_include_friction;        ///< a part of the loads
    std::string outline, wear, stress;  ///< a folder, and files; empty where they are not asked for
    bool timed;
    std::optional<WearPlan> wear_plan{};  ///< if profiles are to wear

    double speed_of(const Case& at) const { return at.speed.value_or(speed); }
};

/// Contacts and, if asked for, friction of a position, which may be those of other profiles in the same places.
rollbem::WheelsetForces forces_at(const Settings& settings, const rollbem::WheelsetOnTrack& wheelset, const Case& at);

/// Declares the options of profile_study; its footer is for the program.
void add_options(study::Options& options);

/// Throws BadInput.
Settings read_settings(const study::Options& options);

// --- equivalent conicity

/// Declares --conicity and what belongs to it, before add_method_options().
void add_conicity_options(study::Options& options);

/// Delta r of a wheelset if it has an equilibrium, and what --conicity asks for.
struct Conicity {
    rollbem::WheelsetOnTrack wheelset;
    bool of_radii;                 ///< --rolling-radii
    std::vector<double> places{};  ///< amplitudes, of radii lateral positions [m]
    std::optional<rollbem::WheelsetOnTrack::RadiusDifference> radii{};
    rollbem::Status status = rollbem::Status::ok;  ///< why there is no equilibrium
};
Conicity read_conicity(const study::Options& options);  ///< throws BadInput
study::Table conicity_table(const Conicity& conicity);
std::string conicity_help();  ///< the columns and their meanings

// --- wear

/// Declares the options of wear.
void add_wear_options(study::Options& options);

/// The plan, if --positions has a column distance. Throws BadInput, also for options of wear without it.
std::optional<WearPlan> read_wear(const study::Options& options, const std::vector<Case>& cases, bool has_distance,
                                  bool has_passages);

/// Wear step by step, a row for each search of contacts.
class WearRun {
public:
    explicit WearRun(const Settings& settings);
    ~WearRun();
    study::Table table(study::OutputFiles& files);

private:
    struct State;
    std::unique_ptr<State> state_;
};
std::string wear_help();  ///< the columns and their meanings

// --- methods for the normal problem

/// Declares --virtual-penetration, and what it takes of the others' options.
void add_method_options(study::Options& options);

struct MethodScene {
    rollbem::WheelsetOnTrack wheelset;
    std::vector<double> shifts;
    double load;  ///< on each wheel [N]
    bool timed;
};
MethodScene read_methods(const study::Options& options);  ///< throws BadInput
study::Table method_table(const MethodScene& scene);
std::string method_help();  ///< the columns and their meanings

// --- profiles by name or from files

/// Declares --wheel, --rail, their material, and the options that they need.
void add_profile_options(study::Options& options);

/// Declares the dimensions of the track, and reads them. Throws BadInput.
void add_track_options(study::Options& options);
rollbem::WheelOnRail::Dimensions read_dimensions(const study::Options& options);

/// Both wheels on their rails; the sidecar notes which profiles were cleaned or turned. Throws BadInput.
rollbem::WheelsetOnTrack read_wheelset(const study::Options& options,
                                       const rollbem::WheelOnRail::Dimensions& dimensions);

// --- pictures

struct Drawn {
    bool left;
    rollbem::RailPatch patch;  ///< as on the right wheel
};

/// Patches from above: pressures as shares of the largest one, and outlines; the last title counts rows
/// `without` a patch.
study::Picture draw_patches(const std::vector<Drawn>& patches, std::size_t without);

struct Worn {
    std::string name;
    rollbem::Profile before, after;
    rollbem::Profile::Use body;
};

/// Profiles before and after wear, a panel each, and the worn ones at ten times the depth.
study::Picture draw_wear(const std::vector<Worn>& bodies);

/// Wheel above rail, round and straight ones, and lines that join where they touch, one for each row.
study::Picture draw_contact_points(const rollbem::WheelsetOnTrack& wheelset, const study::Records& rows);

}  // namespace profile
