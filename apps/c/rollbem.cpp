// The C interface: the library behind plain numbers, handles and codes. No exception leaves it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include <Eigen/Core>
#include <rollbem.h>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/detail/require.hpp>
#include <rollbem/elasticity/patch_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/load.hpp>
#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/profile_file.hpp>
#include <rollbem/normal/wheel_on_rail.hpp>
#include <rollbem/rolling/run.hpp>
#include <rollbem/steady/creep_coefficients.hpp>
#include <rollbem/steady/steady.hpp>
#include <rollbem/vehicle/contact_table.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>

using namespace rollbem;

namespace {

thread_local std::string last_error;

int failed(const std::string& message, int code = ROLLBEM_FAILED) {
    last_error = message;
    return code;
}

/// The code of a computation.
int outcome(const char* who, Status status) {
    return status == Status::ok ? ROLLBEM_OK : failed(std::string(who) + ": status is " + name(status));
}

/// An argument that may not be NULL.
struct Given {
    const char* name;
    const void* pointer;
};

/// Throws std::invalid_argument, naming the first argument that is NULL.
void require_given(const char* function, std::initializer_list<Given> arguments) {
    for (const Given& argument : arguments) {
        detail::require(argument.pointer != nullptr, function, argument.name, "NULL", "not be NULL");
    }
}

/// Calls body(function) for a function of the interface and returns its code: that of the body, ROLLBEM_OK if it
/// returns none, or that of an exception.
template <class Body>
int call(const char* function, std::initializer_list<Given> arguments, const Body& body) noexcept {
    try {
        require_given(function, arguments);
        if constexpr (std::is_void_v<decltype(body(function))>) {
            body(function);
            return ROLLBEM_OK;
        } else {
            return body(function);
        }
    } catch (const std::invalid_argument& error) {
        return failed(error.what(), ROLLBEM_INVALID);
    } catch (const std::exception& error) {
        return failed(error.what());
    }
}

/// The handle from make(function); null if it throws.
template <class Make>
auto made(const char* function, std::initializer_list<Given> arguments, const Make& make) noexcept {
    decltype(make(function).release()) handle = nullptr;
    call(function, arguments, [&](const char* who) { handle = make(who).release(); });
    return handle;
}

/// Writes numbers in a row, and returns the place behind them.
double* put(double* to, std::initializer_list<double> values) { return std::copy(values.begin(), values.end(), to); }
double* put(double* to, const TangentialForce& of) { return put(to, {of.longitudinal, of.lateral, of.moment}); }
double* put(double* to, const TangentialForce::ByCreepage& of) {
    return put(put(put(to, of.by_longitudinal), of.by_lateral), of.by_spin);
}

std::filesystem::path path_of(const char* utf8) {
    return std::u8string(utf8, utf8 + std::char_traits<char>::length(utf8));
}

Creepage creepage_from(const double* numbers) { return {numbers[0], numbers[1], numbers[2]}; }

}  // namespace

struct rollbem_table {
    CreepForceTable table;
};

struct rollbem_contact_table {
    ContactTable table;
    std::array<ContactTable::Friction, 2> friction{};  // left and right
};

struct rollbem_patch {
    using Model = FrictionModel;

    rollbem_patch(const PatchContact& contact, double mu, double load, const PatchMesh<double>& mesh)
        : load_(load),
          a_(contact.half_length()),
          b_(contact.half_width()),
          pressure_(hertz_pressures(contact, mesh, load)),
          model_(contact, breathing_system(contact, mesh, scheme, HalfSpace<double>(contact.poisson_ratio())),
                 judge_stability(patch_subsystems(mesh, scheme, HalfSpace<double>(contact.poisson_ratio()))),
                 Friction{mu, pressure_}),
          run_(model_),
          under_{pressure_, a_, pressure_ / (3 * load), b_} {}

    /// Sets the load, solves by try_solve(under) and writes the results.
    template <class Solve>
    int solve(const char* who, double load, const Solve& try_solve, double* force, double* tangent, double* work) {
        // a and b grow like N^(1/3), and so do pressures
        const double scale = std::cbrt(load / load_);
        under_.normal_pressure = scale * pressure_;
        under_.half_length = scale * a_;
        under_.half_width = scale * b_;
        under_.pressure_rate = scale / (3 * load) * pressure_;
        const FrictionStep step = try_solve(under_);
        put(force, step.force);
        if (work != nullptr) *work = step.slip_work;
        if (tangent != nullptr) {
            // the rate of b is contained in tangent_by_half_length, as b follows a
            put(put(tangent, step.tangent),
                step.tangent_by_load + under_.half_length / (3 * load) * step.tangent_by_half_length);
        }
        return outcome(who, step.status);
    }

    /// Calls visit(number) for all numbers of a state in turn.
    template <class State, class Visit>
    static void for_state(State& state, const Visit& visit) {
        for (auto* vectors : {&state.traction, &state.unrotated_traction}) {
            for (Eigen::Index i = 0; i < vectors->size(); ++i) visit(vectors->data()[i]);
        }
        for (Eigen::Index i = 0; i < state.normal_pressure.size(); ++i) visit(state.normal_pressure[i]);
        visit(state.half_length);
        visit(state.half_width);
    }

    static constexpr NodeDifference scheme{Nodes::chebyshev};

    double load_, a_, b_;
    Eigen::ArrayXd pressure_;
    Model model_;
    Run<Model> run_;
    NormalLoad under_;
};

struct rollbem_wheel {
    WheelOnRail wheel;
    WheelOnRail::Options options{};
    std::string notes{};
    WheelOnRail::Workspace workspace{};

    /// Writes the patches at a position, under a load or, without one, at its height.
    int solve(const char* who, const WheelsetPosition& at, const double* load, size_t most, double* patches,
              size_t* count) {
        require_given(who, {{"count", count}});
        if (most > 0) require_given(who, {{"patches", patches}});
        *count = 0;
        if (load != nullptr) detail::require_positive(who, "load", *load);
        const WheelOnRail::Contact found = load != nullptr ? wheel.solve_for_load(at, *load, workspace, options)
                                                           : wheel.solve_at_height(at, workspace, options);
        if (!has_numbers(found.status)) return outcome(who, found.status);
        for (const RailPatch& patch : found.patches) {
            if ((*count)++ >= most) continue;
            patches =
                put(patches, {patch.x, patch.y, patch.z, patch.angle, patch.rolling_radius, patch.load, patch.approach,
                              patch.peak_pressure, patch.area, patch.half_length, patch.half_width, found.height});
        }
        return ROLLBEM_OK;
    }
};

const char* rollbem_last_error(void) { return last_error.c_str(); }
const char* rollbem_version(void) { return ROLLBEM_VERSION; }

// --- creep forces by look-up -----------------------------------------------------------------------------------------

rollbem_table* rollbem_table_open(const char* path) {
    return made(__func__, {{"path", path}}, [&](const char*) {
        return std::make_unique<rollbem_table>(rollbem_table{CreepForceTable::read(path_of(path))});
    });
}

void rollbem_table_close(rollbem_table* table) { delete table; }

/// The forces of one contact in `found`, and the code.
static int look_up(const char* who, const CreepForceTable& table, const double* contact,
                   CreepForceTable::Force& found) {
    found = table.look_up(PatchContact({contact[0], contact[1], contact[2], contact[3]}), contact[4], contact[5],
                          creepage_from(contact + 6));
    if (found.status != Status::ok || found.a_over_b_on_table) return outcome(who, found.status);
    const CreepForceTable::Grid& grid = table.grid();
    return failed(std::string(who) + ": a/b = " + detail::to_text(contact[0] / contact[1]) +
                      " lies beyond the table, " + detail::to_text(grid.smallest_a_over_b()) + " to " +
                      detail::to_text(grid.largest_a_over_b()) + ": its border gives the forces",
                  ROLLBEM_OFF_TABLE);
}

int rollbem_table_forces(const rollbem_table* table, size_t count, const double* contacts, double* forces,
                         double* tangents) {
    return call(__func__, {{"table", table}}, [&](const char* who) {
        if (count > 0) require_given(who, {{"contacts", contacts}, {"forces", forces}});
        const auto severity = [](int of) { return of == ROLLBEM_OK ? 0 : of == ROLLBEM_OFF_TABLE ? 1 : 2; };
        int code = ROLLBEM_OK;
        std::string message;  // about the first of the worst contacts
        for (size_t i = 0; i < count; ++i, contacts += 9) {
            CreepForceTable::Force found;
            const int own = call(who, {}, [&](const char*) { return look_up(who, table->table, contacts, found); });
            forces = put(forces, found.force);
            if (tangents != nullptr) {
                tangents = put(tangents, found.tangent);
                for (const auto& by : {found.tangent_by_load, found.tangent_by_friction_coefficient,
                                       found.tangent_by_half_length, found.tangent_by_half_width}) {
                    tangents = put(tangents, by);
                }
            }
            if (severity(own) <= severity(code)) continue;
            code = own;
            message = last_error + " (contact " + std::to_string(i) + ")";
        }
        return code == ROLLBEM_OK ? code : failed(message, code);
    });
}

// --- wheelsets by look-up --------------------------------------------------------------------------------------------

rollbem_contact_table* rollbem_contact_table_open(const char* path) {
    return made(__func__, {{"path", path}}, [&](const char*) {
        return std::make_unique<rollbem_contact_table>(rollbem_contact_table{ContactTable::read(path_of(path))});
    });
}

void rollbem_contact_table_close(rollbem_contact_table* table) { delete table; }

namespace {

WheelsetSide side_of(const char* who, int side) {
    detail::require(side == ROLLBEM_LEFT || side == ROLLBEM_RIGHT, who, "side", side, "be 0 (left) or 1 (right)");
    return side == ROLLBEM_LEFT ? WheelsetSide::left : WheelsetSide::right;
}

void require_covered(const char* who, const ContactTable& table, double lateral, double yaw) {
    const auto within = [](double most) { return "lie within +-" + detail::to_text(most); };
    detail::require(table.covers(lateral, 0), who, "lateral position", lateral, within(table.largest_shift()).c_str());
    detail::require(table.covers(0, yaw), who, "yaw", yaw, within(table.largest_yaw()).c_str());
}

/// The code of a look-up without result, with the first input that alone breaks its rule.
int refused(const std::string& status, const ContactTable& table, const double inputs[11]) {
    constexpr std::array names{
        "lateral position", "yaw",       "forward speed", "pitch rate", "lateral speed",
        "vertical speed",   "roll rate", "yaw rate",      "load",       "coefficient of friction"};
    const char* const who = status.c_str();
    try {
        for (std::size_t k = 0; k < names.size(); ++k) detail::require_finite(who, names[k], inputs[k]);
        require_covered(who, table, inputs[0], inputs[1]);
        for (const std::size_t k : {std::size_t(WheelForces::load), std::size_t(WheelForces::mu)}) {
            detail::require(inputs[k] >= 0, who, names[k], inputs[k], "not be negative");
        }
    } catch (const std::invalid_argument& error) {
        return failed(error.what());
    }
    return failed(status);
}

}  // namespace

int rollbem_contact_table_look_up(const rollbem_contact_table* table, const rollbem_table* creep, int side,
                                  const double inputs[11], double force[6], double tangent[66], double points[40],
                                  double* heat) {
    return call(
        __func__, {{"table", table}, {"creep", creep}, {"inputs", inputs}, {"force", force}}, [&](const char* who) {
            const WheelsetSide of = side_of(who, side);
            ContactTable::Load load(inputs[WheelForces::load]);
            if (!std::isnan(inputs[WheelForces::roll])) load.roll = inputs[WheelForces::roll];
            const WheelsetPosition at{.lateral = inputs[WheelForces::lateral], .yaw = inputs[WheelForces::yaw]};
            const WheelsetSpeeds speeds{inputs[WheelForces::forward],       inputs[WheelForces::pitch_rate],
                                        inputs[WheelForces::lateral_speed], inputs[WheelForces::vertical_speed],
                                        inputs[WheelForces::roll_rate],     inputs[WheelForces::yaw_rate]};
            ContactTable::Friction friction = table->friction[std::size_t(side)];
            friction.coefficient = inputs[WheelForces::mu];
            const WheelForces now = tangent == nullptr
                                        ? table->table.forces(creep->table, of, at, speeds, load, friction)
                                        : table->table.look_up(creep->table, of, at, speeds, load, friction);
            std::copy(now.force.begin(), now.force.end(), force);
            if (tangent != nullptr) std::copy_n(now.tangent.data(), now.tangent.size(), tangent);
            const bool known = detail::is_finite(now.force[0]);
            if (heat != nullptr) *heat = known ? now.heat : now.force[0];
            if (tangent != nullptr && !known) std::fill_n(tangent, now.tangent.size(), now.force[0]);
            for (double* to = points; const WheelForces::Point& point : now.points) {
                if (points == nullptr) break;
                to = put(to,
                         {point.load_share, point.arm[0], point.arm[1], point.arm[2], point.angle, point.rolling_radius,
                          point.normal_load, point.peak_pressure, point.rail_y, point.wheel_y});
            }
            if (now.status != Status::ok) {
                return refused(std::string(who) + ": status is " + name(now.status), table->table, inputs);
            }
            if (now.load_on_table || load.vertical == 0) return int(ROLLBEM_OK);
            const auto& loads = table->table.grid().loads;
            return failed(std::string(who) + ": load = " + detail::to_text(load.vertical) + " lies beyond the table, " +
                              detail::to_text(loads.front()) + " to " + detail::to_text(loads.back()) +
                              ": its border gives the contacts",
                          ROLLBEM_OFF_TABLE);
        });
}

int rollbem_contact_table_set_friction(rollbem_contact_table* table, int side, const double factors[4]) {
    return call(__func__, {{"table", table}, {"factors", factors}}, [&](const char* who) {
        side_of(who, side);
        for (std::size_t zone = 0; zone < ContactTable::Zones::most; ++zone) {
            detail::require_not_negative(who, "factor", factors[zone]);
        }
        std::copy_n(factors, ContactTable::Zones::most, table->friction[std::size_t(side)].factor.begin());
    });
}

int rollbem_contact_table_support(const rollbem_contact_table* table, int side, double lateral, double yaw,
                                  double height, double load[4]) {
    return call(__func__, {{"table", table}, {"load", load}}, [&](const char* who) {
        std::fill_n(load, 4, std::numeric_limits<double>::quiet_NaN());
        const WheelsetSide of = side_of(who, side);
        detail::require_finite(who, "height", height);
        require_covered(who, table->table, lateral, yaw);
        const auto now = table->table.load_at_height(of, lateral, yaw, height);
        if (now.status == Status::ok) put(load, {now.load, now.by_height, now.by_lateral, now.by_yaw});
        return outcome(who, now.status);
    });
}

int rollbem_contact_table_range(const rollbem_contact_table* table, double range[4]) {
    return call(__func__, {{"table", table}, {"range", range}}, [&](const char*) {
        const auto& loads = table->table.grid().loads;
        put(range, {table->table.largest_shift(), table->table.largest_yaw(), loads.front(), loads.back()});
    });
}

int rollbem_contact_table_on_rails(const rollbem_contact_table* table, double lateral, double yaw,
                                   const double loads[2], double height[5], double roll[5]) {
    return call(
        __func__, {{"table", table}, {"loads", loads}, {"height", height}, {"roll", roll}}, [&](const char* who) {
            for (double* result : {height, roll}) std::fill_n(result, 5, std::numeric_limits<double>::quiet_NaN());
            require_covered(who, table->table, lateral, yaw);
            for (const double load : {loads[0], loads[1]}) detail::require_positive(who, "load", load);
            const auto at = table->table.on_rails(lateral, yaw, {loads[0], loads[1]});
            put(height,
                {at.height, at.height_by_lateral, at.height_by_yaw, at.height_by_load[0], at.height_by_load[1]});
            put(roll, {at.roll, at.roll_by_lateral, at.roll_by_yaw, at.roll_by_load[0], at.roll_by_load[1]});
        });
}

// --- Hertz and Kalker ------------------------------------------------------------------------------------------------

int rollbem_hertz(double load, const double radii[4], double angle, const double bodies[4], double result[5]) {
    return call(__func__, {{"radii", radii}, {"bodies", bodies}, {"result", result}}, [&](const char*) {
        const HertzEllipse ellipse({.load = load,
                                    .radii_1 = {radii[0], radii[1]},
                                    .radii_2 = {radii[2], radii[3]},
                                    .angle = angle,
                                    .body_1 = {bodies[0], bodies[1]},
                                    .body_2 = {bodies[2], bodies[3]}});
        put(result,
            {ellipse.half_length(), ellipse.half_width(), ellipse.approach(), ellipse.peak_pressure(), ellipse.turn()});
    });
}

int rollbem_kalker(double a_over_b, double poisson_ratio, int n, double coefficients[5]) {
    return call(__func__, {{"coefficients", coefficients}}, [&](const char* who) {
        const PatchContact contact({a_over_b, 1, 1, poisson_ratio});
        const auto steady = solve_steady(contact, patch_mesh(contact, n, n), rollbem_patch::scheme);
        const CreepCoefficients<double> c = creep_coefficients(contact, steady);
        const auto confirmed = [&](Eigen::Index i, Eigen::Index j, double value) {
            return is_confirmed(steady, i, j) ? value : std::numeric_limits<double>::quiet_NaN();
        };
        put(coefficients, {confirmed(0, 0, c.c11), confirmed(1, 1, c.c22), confirmed(1, 2, c.c23),
                           confirmed(2, 1, c.c32), confirmed(2, 2, c.c33)});
        return outcome(who, steady.status);
    });
}

// --- a patch in the time domain --------------------------------------------------------------------------------------

rollbem_patch* rollbem_patch_new(double half_length, double half_width, double shear_modulus, double poisson_ratio,
                                 double friction_coefficient, double load, int elements, int strips) {
    return made(__func__, {}, [&](const char*) {
        const PatchContact contact({half_length, half_width, shear_modulus, poisson_ratio});
        return std::make_unique<rollbem_patch>(contact, friction_coefficient, load,
                                               patch_mesh(contact, elements, strips));
    });
}

void rollbem_patch_free(rollbem_patch* patch) { delete patch; }

int rollbem_patch_step(rollbem_patch* patch, double distance, const double creepage[3], double load, double force[3],
                       double tangent[12], double* slip_work) {
    return call(__func__, {{"patch", patch}, {"creepage", creepage}, {"force", force}}, [&](const char* who) {
        const auto solve = [&](const auto& under) {
            return patch->run_.try_advance({distance, creepage_from(creepage), under});
        };
        return patch->solve(who, load, solve, force, tangent, slip_work);
    });
}

int rollbem_patch_steady(rollbem_patch* patch, const double creepage[3], double load, double force[3],
                         double tangent[12], double* slip_work) {
    return call(__func__, {{"patch", patch}, {"creepage", creepage}, {"force", force}}, [&](const char* who) {
        // lengths and pressures grow like N^(1/3): F = N f(xi/N^(1/3), eta/N^(1/3), phi); M_z has a further N^(1/3)
        const auto solve = [&](const auto& under) {
            FrictionStep step = patch->run_.try_steady({.motion = creepage_from(creepage), .load = under});
            const TangentialForce& f = step.force;
            step.tangent_by_load = 1 / load * TangentialForce{f.longitudinal, f.lateral, 4 * f.moment / 3} +
                                   -creepage[0] / (3 * load) * step.tangent.by_longitudinal +
                                   -creepage[1] / (3 * load) * step.tangent.by_lateral;
            step.tangent_by_half_length = {0, 0, 0};
            return step;
        };
        return patch->solve(who, load, solve, force, tangent, slip_work);
    });
}

void rollbem_patch_accept(rollbem_patch* patch) {
    call(__func__, {{"patch", patch}}, [&](const char*) { patch->run_.accept(); });
}

size_t rollbem_patch_state_size(const rollbem_patch* patch) {
    size_t size = 0;
    call(__func__, {{"patch", patch}}, [&](const char*) {
        size = patch->run_.now().zones.size();
        rollbem_patch::for_state(patch->run_.now(), [&](double) { ++size; });
    });
    return size;
}

void rollbem_patch_get_state(const rollbem_patch* patch, double* state) {
    call(__func__, {{"patch", patch}, {"state", state}}, [&](const char*) {
        const auto& now = patch->run_.now();
        rollbem_patch::for_state(now, [&](double value) { *state++ = value; });
        for (const Zone zone : now.zones) *state++ = static_cast<double>(zone);
    });
}

int rollbem_patch_set_state(rollbem_patch* patch, const double* state) {
    return call(__func__, {{"patch", patch}, {"state", state}}, [&](const char*) {
        auto& now = patch->run_.now();
        rollbem_patch::for_state(now, [&](double& value) { value = *state++; });
        for (Zone& zone : now.zones) zone = *state++ != 0 ? Zone::slip : Zone::stick;
    });
}

// --- a wheel on a rail, by their profiles ----------------------------------------------------------------------------

namespace {

/// Dimensions of a track in the order of rollbem_wheel_new().
struct Dimension {
    double rollbem_wheel_options::*option;
    double WheelOnRail::Dimensions::*of;
};
constexpr Dimension dimensions_of_tracks[] = {
    {&rollbem_wheel_options::gauge, &WheelOnRail::Dimensions::gauge},
    {&rollbem_wheel_options::gauge_depth, &WheelOnRail::Dimensions::gauge_depth},
    {&rollbem_wheel_options::flange_back, &WheelOnRail::Dimensions::flange_back},
    {&rollbem_wheel_options::tape_offset, &WheelOnRail::Dimensions::tape_offset},
    {&rollbem_wheel_options::radius, &WheelOnRail::Dimensions::radius},
    {&rollbem_wheel_options::shear_modulus, &WheelOnRail::Dimensions::shear_modulus},
    {&rollbem_wheel_options::poisson_ratio, &WheelOnRail::Dimensions::poisson_ratio}};

rollbem_wheel_options default_options() {
    rollbem_wheel_options options{};
    options.size = sizeof options;
    options.interaction = 1;
    options.per_metre = 1;
    options.cant = detail::usual_cant;
    for (const auto& [option, of] : dimensions_of_tracks) options.*option = WheelOnRail::Dimensions{}.*of;
    return options;
}

/// The options of a program, checked, or the defaults.
rollbem_wheel_options options_from(const char* who, const rollbem_wheel_options* given) {
    if (given == nullptr) return default_options();
    detail::require(given->size == sizeof *given, who, "options.size", given->size,
                    "be the size that rollbem_wheel_defaults() sets");
    for (const auto& [quantity, flag] : {std::pair("options.any_shape", given->any_shape),
                                         {"options.by_origin", given->by_origin},
                                         {"options.interaction", given->interaction}}) {
        detail::require(flag == 0 || flag == 1, who, quantity, flag, "be 0 or 1");
    }
    for (const int mirror : {given->wheel_mirror, given->rail_mirror}) {
        detail::require(mirror >= 0 && mirror <= (ROLLBEM_MIRROR_Y | ROLLBEM_MIRROR_Z), who, "mirror in options",
                        mirror, "be a sum of ROLLBEM_MIRROR_Y and ROLLBEM_MIRROR_Z");
    }
    return *given;
}

/// How to read a profile; smoothing applies to one from a file.
ProfileFile::Options file_options(const rollbem_wheel_options& o, const std::filesystem::path& name, Profile::Use use,
                                  int mirror) {
    return {.per_metre = o.per_metre,
            .mirror_y = (mirror & ROLLBEM_MIRROR_Y) != 0,
            .mirror_z = (mirror & ROLLBEM_MIRROR_Z) != 0,
            .smooth = is_standard_profile(name, use) ? 0 : o.smooth,
            .tape_offset = o.tape_offset};
}

WheelsetPosition position_from(const double* p) { return {p[0], p[1], p[2], p[3], p[4], p[5]}; }

}  // namespace

rollbem_wheel* rollbem_wheel_new(const double* wheel, size_t wheel_points, const double* rail, size_t rail_points,
                                 const double dimensions[7]) {
    return made(__func__, {}, [&](const char* who) {
        const auto profile = [who](const char* quantity, const double* points, size_t count, const auto& standard) {
            if (points == nullptr) {
                detail::require(count == 0, who, quantity, count, "be 0 where its points are NULL");
                return standard();
            }
            const Eigen::Map<const Eigen::Array2Xd> of(points, 2, static_cast<Eigen::Index>(count));
            return Profile(of.row(0), of.row(1));
        };
        WheelOnRail::Dimensions track;
        for (const Dimension& one : dimensions_of_tracks) {
            if (dimensions != nullptr) track.*one.of = *dimensions++;
        }
        return std::make_unique<rollbem_wheel>(
            rollbem_wheel{WheelOnRail(profile("wheel_points", wheel, wheel_points, [] { return s1002(); }),
                                      profile("rail_points", rail, rail_points, [] { return rail_60e1(); }), track)});
    });
}

void rollbem_wheel_free(rollbem_wheel* wheel) { delete wheel; }

int rollbem_wheel_defaults(rollbem_wheel_options* options, size_t size) {
    return call(__func__, {{"options", options}}, [&](const char* who) {
        detail::require(size == sizeof *options, who, "size", size,
                        "be the size of rollbem_wheel_options in this version");
        *options = default_options();
    });
}

rollbem_wheel* rollbem_wheel_open(const char* wheel_path, const char* rail_path, const rollbem_wheel_options* options) {
    return made(__func__, {}, [&](const char* who) {
        const rollbem_wheel_options o = options_from(who, options);
        const bool any_shape = o.any_shape != 0, by_origin = o.by_origin != 0;
        WheelOnRail::Dimensions track;
        for (const auto& [option, of] : dimensions_of_tracks) track.*of = o.*option;
        if (by_origin) track.rail_origin = WheelOnRail::Dimensions::Origin{o.rail_origin[0], o.rail_origin[1]};
        const auto wheel_name = path_of(wheel_path != nullptr ? wheel_path : "s1002"),
                   rail_name = path_of(rail_path != nullptr ? rail_path : "60e1");
        const auto cant = o.cant != detail::usual_cant ? std::optional(o.cant) : std::nullopt;
        const ProfileFile::Wheel wheel =
            open_wheel(wheel_name, file_options(o, wheel_name, Profile::Use::wheel, o.wheel_mirror), any_shape);
        const ProfileFile::Rail rail =
            open_rail(rail_name, file_options(o, rail_name, Profile::Use::rail, o.rail_mirror),
                      {cant, o.roller_radius, by_origin}, any_shape);
        std::string notes;
        for (const auto* of_wheel : {&wheel.notes, &wheel.doubts}) {
            for (const std::string& note : *of_wheel) notes += "wheel: " + note + "\n";
        }
        for (const auto* of_rail : {&rail.notes, &rail.doubts}) {
            for (const std::string& note : *of_rail) notes += "rail: " + note + "\n";
        }
        return std::make_unique<rollbem_wheel>(rollbem_wheel{
            WheelOnRail(wheel.surface, rail.surface, track), {.interaction = o.interaction != 0}, std::move(notes)});
    });
}

const char* rollbem_wheel_notes(const rollbem_wheel* wheel) { return wheel != nullptr ? wheel->notes.c_str() : ""; }

int rollbem_wheel_carry(rollbem_wheel* wheel, double lateral, double roll, double yaw, double load, size_t most,
                        double* patches, size_t* count) {
    return call(__func__, {{"wheel", wheel}}, [&](const char* who) {
        if (count != nullptr) *count = 0;
        detail::require_finite(who, "lateral", lateral);
        detail::require_finite(who, "roll", roll);
        detail::require_finite(who, "yaw", yaw);
        return wheel->solve(who, {.lateral = lateral, .roll = roll, .yaw = yaw}, &load, most, patches, count);
    });
}

int rollbem_wheel_solve_for_load(rollbem_wheel* wheel, const double position[6], double load, size_t most,
                                 double* patches, size_t* count) {
    return call(__func__, {{"wheel", wheel}, {"position", position}}, [&](const char* who) {
        return wheel->solve(who, position_from(position), &load, most, patches, count);
    });
}

int rollbem_wheel_solve_at_height(rollbem_wheel* wheel, const double position[6], size_t most, double* patches,
                                  size_t* count) {
    return call(__func__, {{"wheel", wheel}, {"position", position}}, [&](const char* who) {
        return wheel->solve(who, position_from(position), nullptr, most, patches, count);
    });
}
