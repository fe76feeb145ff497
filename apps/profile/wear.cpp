#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <rollbem/detail/parallel_for.hpp>
#include <rollbem/normal/profile_wear.hpp>
#include <rollbem/vehicle/wear.hpp>

#include "profile.hpp"
#include "support/input.hpp"
#include "support/sheet.hpp"

namespace profile {

namespace {

using rollbem::Profile;
using Use = rollbem::Profile::Use;

constexpr double spacing = 2e-4, cell = 1e-4;  // of points of worn profiles, and of sums of wear [m]
constexpr double most_searches = 1e4;
constexpr double reach = 2e-3;  // of wear along a profile [m]: places in service vary between those of a collective

}  // namespace

/// What the whole collective takes off a body at its points, spread along the profile.
struct WearRates {
    Eigen::ArrayXd area;    ///< per length [m]
    Eigen::ArrayXd strain;  ///< depth over the elastic compression p b (1 - nu)/G of the patches that wear there

    /// The largest share of the collective that wears off `step` at most, and a quarter of what surfaces approach
    /// elastically: contacts move to other places as they wear, and larger explicit steps go to and fro.
    double part(double step) const { return 1 / std::max(area.maxCoeff() / step, 4 * strain.maxCoeff()); }
};

/// A wheel or a rail that wears.
struct WearingBody {
    WearingBody(const Profile& profile, Use own) : before(refined(profile, spacing)), now(before), use(own) {}

    Profile before, now;
    Use use;
    Eigen::ArrayXd last{};  ///< what the collective would have taken off by the search before
    double last_part = 0;   ///< of the collective, after that search

    /// After a part of the collective, which takes off `area` by the last search, extrapolated from the one before to
    /// the middle of the step: contacts spread as they wear (Adams and Bashforth's second order).
    Profile after(const Eigen::ArrayXd& area, double part) const {
        if (last.size() == 0) return worn_by_area(now, part * area, use);
        return worn_by_area(now, part * (area + part / (2 * last_part) * (area - last)).cwiseMax(0), use);
    }
    void wear(Profile next, const Eigen::ArrayXd& area, double part) {
        now = std::move(next);
        last = area;
        last_part = part;
    }
};

/// A row: the profiles at a search.
struct WearRow {
    double distance;
    std::array<double, 3> wheel, rail;  ///< largest depth, its y in the axes of the file, area
    rollbem::Profile::FlangeSizes flange;
    rollbem::Profile::RailWear head;
    bool has_rail;
    std::string status;
};

namespace {

study::Sheet<WearRow, Side> wear_sheet() {
    using R = WearRow;
    const auto of_rail = [](const auto& value) { return study::where(&R::has_rail, value); };
    return {"",
            {{"distance", "distance rolled when contacts are found anew, in the last row at the end [m]", &R::distance},
             {"wheel_depth", "largest depth worn off the wheel along its normals [m]",
              [](const R& r) { return r.wheel[0]; }},
             {"wheel_depth_y", "y of that place on the worn wheel, in the axes of its file [m]",
              [](const R& r) { return r.wheel[1]; }},
             {"wheel_area", "area worn off the wheel's section [m^2]", [](const R& r) { return r.wheel[2]; }},
             {"rail_depth", "the same of the rail, as the columns after it; empty without passages",
              of_rail([](const R& r) { return r.rail[0]; })},
             {"rail_depth_y", "", of_rail([](const R& r) { return r.rail[1]; })},
             {"rail_area", "", of_rail([](const R& r) { return r.rail[2]; })},
             {"flange_height", "EN 15313's Sh: tip of the flange below the tape circle's point [m]",
              [](const R& r) { return r.flange.height; }},
             {"flange_thickness",
              "Sd: from the back of the flange horizontally to its face 10 mm below the tape circle's point [m]",
              [](const R& r) { return r.flange.thickness; }},
             {"qr", "qR: horizontally from there along the face to 2 mm above the tip [m]",
              [](const R& r) { return r.flange.qr; }},
             {"rail_vertical_wear", "worn off the rail vertically at y = 0 of the new profile [m]",
              of_rail([](const R& r) { return r.head.vertical; })},
             {"rail_side_wear", "worn off the rail's inner side --gauge-depth below the new rail's top [m]",
              of_rail([](const R& r) { return r.head.side; })},
             {"status", "worst status of the contacts in all positions, as above", &R::status}},
            ""};
}

std::array<rollbem::ProfileWear, 2> sums_over(const Profile& profile) {
    const rollbem::ProfileWear one(profile, Eigen::Index(profile.length() / cell) + 1);
    return {one, one};
}

rollbem::ProfileWear::Law read_law(const study::Options& options) {
    const std::string name = options.text("wear-law");
    if (name == "t-gamma") return rollbem::ProfileWear::Law::t_gamma();
    if (name == "archard-kth") return rollbem::ProfileWear::Law::archard_kth();
    std::error_code unknown;
    options.require(std::filesystem::exists(name, unknown), "wear-law",
                    "be t-gamma, archard-kth or a file that can be read");
    const std::vector<study::Numbers> columns = study::read_columns(options, "wear-law", "t_gamma_per_area,rate");
    options.require(!columns[0].empty(), "wear-law", "have a row below its header");
    return study::blame(options.said("wear-law"), [&] { return rollbem::ProfileWear::Law(columns[0], columns[1]); });
}

}  // namespace

std::string wear_help() {
    return R"(A column distance in --positions: the wheel of --side wears, and its rail by the passages, both by --wear-law, 7850
kg/m^3. All positions wear together, each by its share, until something is --wear-step deep, or a quarter as deep as
surfaces approach each other elastically; then contacts are found anew. The wheel's section loses the volume per metre
rolled V' times distance/(2 pi r), the rail's V' passages. Wear is spread along the profile over 2 mm, as places vary in
service and waves must not grow; its area stays. A row for each search, the first one of the profiles as they are read;
where contacts have no result, the run ends with the row and the profiles of that search:
)" + wear_sheet().help() +
           R"(--worn-wheel, --worn-rail: to be read with the same --tape-offset, --cant and --rail-origin, but without --...-mirror,
--length-unit, --smooth and --align-...; --gauge places a worn rail by its worn side. With one friction a position:
  profile_study --positions curves.csv --speed 20 --wear-law t-gamma --worn-wheel worn.csv --plot worn.svg
)";
}

void add_wear_options(study::Options& options) {
    options.group("Wear, with a column distance in --positions");
    const std::vector<std::string> with{"positions"};
    options
        .add("wear-law", "NAME|FILE",
             "law of wear of wheel and rail: t-gamma (Braghin et al. 2006), archard-kth (Jendel 2002), or CSV file "
             "with the columns t_gamma_per_area [N/mm^2],rate [ug/(m mm^2)]",
             "t-gamma")
        .only_with(with);
    options.add("wear-step", "D", "largest depth worn off between two searches of contacts [m], 1e-7 to 0.01", "1e-4")
        .only_with(with);
    options.add_output("worn-wheel", "CSV file of the worn wheel, y, z [m] as --wheel reads them; none without it")
        .only_with(with);
    options
        .add_output("worn-rail",
                    "CSV file of the worn rail, y, z [m] as --rail reads them, before it is canted; none without it")
        .only_with(with);
}

std::optional<WearPlan> read_wear(const study::Options& options, const std::vector<Case>& cases, bool has_distance,
                                  bool has_passages) {
    if (!has_distance) {
        options.require(!has_passages, "positions", "have a column distance [m] beside passages, 0 for rails alone");
        for (const char* name : {"wear-law", "wear-step", "worn-wheel", "worn-rail"}) {
            options.ignored(name, "without a column distance [m] in --positions");
        }
        return {};
    }
    if (!has_passages) options.ignored("worn-rail", "without a column passages in --positions: rails do not wear");
    options.require(options.text("side") != "both", "side", "be left or right with a column distance: one wheel wears");
    for (const char* name : {"outline", "wear", "stress", "temperature", "shard"}) {
        options.ignored(name, "with a column distance in --positions: profiles wear");
    }
    for (const char* name : {"height", "pitch-rate"}) {
        if (!options.given(name)) continue;
        options.require(options.numbers(name, study::finite()).size() == 1, name,
                        "be one value with a column distance in --positions");
    }
    double distance = 0, passages = 0;
    for (const Case& at : cases) {
        distance += at.distance;
        passages += at.passages;
    }
    options.require(distance + passages > 0 && std::isfinite(distance + passages), "positions",
                    "have a distance or passages above 0");
    const bool frictionless = std::none_of(cases.begin(), cases.end(), [](const Case& at) { return at.friction; });
    options.require(options.given("friction") || !frictionless, "positions",
                    "have a column friction for its column distance, or --friction");
    return WearPlan{read_law(options),
                    options.number("wear-step", study::between(1e-7, 1e-2)),
                    options.text("worn-wheel"),
                    options.text("worn-rail"),
                    options.number("cant", study::between(-0.5, 0.5)),
                    options.number("tape-offset", study::finite()),
                    has_passages,
                    study::job_count(options)};
}

struct WearRun::State {
    explicit State(const Settings& given)
        : settings(given),
          plan(*given.wear_plan),
          side(given.sides[0]),
          wheel(given.wheelset.wheel(side).wheel(), Use::wheel),
          rail(given.wheelset.wheel(side).rail(), Use::rail) {
        for (const Case& at : settings.cases) distance += at.distance;
    }

    /// The wheelset with the profiles as they are now, the rail where it was.
    rollbem::WheelsetOnTrack wheelset() const {
        const rollbem::WheelOnRail::Geometry& geometry = settings.wheelset.wheel(side).geometry();
        rollbem::WheelOnRail::Dimensions dimensions = geometry.dimensions();
        dimensions.rail_origin = geometry.rail_origin();
        const double radius = geometry.rail().roller_radius();
        const rollbem::WheelOnRail own(
            wheel.now, radius > 0 ? rollbem::RailSurface::roller(rail.now, radius) : rollbem::RailSurface(rail.now),
            dimensions);
        if (settings.wheelset.is_mirrored()) return rollbem::WheelsetOnTrack(own);
        return side == Side::left ? rollbem::WheelsetOnTrack(own, settings.wheelset.wheel(Side::right))
                                  : rollbem::WheelsetOnTrack(settings.wheelset.wheel(Side::left), own);
    }

    struct Rates {
        WearRates wheel, rail;
    };
    Rates search();
    WearRow row(double share) const;
    void run(const std::function<void(double part)>& done);
    void write(study::OutputFile* wheel_file, study::OutputFile* rail_file) const;

    const Settings& settings;
    const WearPlan& plan;
    Side side;
    WearingBody wheel, rail;
    double distance = 0;  ///< of the collective [m]
    std::string status{}, failure{};
    std::vector<WearRow> rows{};
};

/// Contacts and friction in all positions on the present profiles, and the wear per share of the collective.
WearRun::State::Rates WearRun::State::search() {
    const rollbem::WheelsetOnTrack now = wheelset();
    std::vector<rollbem::WheelsetForces> found(settings.cases.size());
    rollbem::detail::parallel_for(found.size(), plan.jobs,
                                  [&](std::size_t q) { found[q] = forces_at(settings, now, settings.cases[q]); });
    const auto k = std::size_t(side);
    std::array<rollbem::ProfileWear, 2> of_wheel = sums_over(wheel.now), of_rail = sums_over(rail.now);
    rollbem::Status worst = rollbem::Status::ok;
    for (std::size_t q = 0; q < found.size(); ++q) {
        const Case& at = settings.cases[q];
        const rollbem::WheelOnRail::Contact& contact = found[q].contacts.wheels[k];
        const rollbem::WheelsetSpeeds speeds{.forward = settings.speed_of(at), .pitch_rate = found[q].pitch_rate};
        rollbem::Status own = contact.status;
        for (std::size_t i = 0; has_numbers(own) && own != rollbem::Status::unbalanced && i < contact.patches.size();
             ++i) {
            const rollbem::PatchForce& friction = found[q].patches[k][i];
            if (friction.status != rollbem::Status::ok) {
                own = friction.status;
                break;
            }
            const rollbem::RailPatch& patch = contact.patches[i];
            const rollbem::PatchForce wear = wear_of(friction, plan.law, rolling_velocity_of(patch, speeds));
            const std::array<double, 2> factors{
                1, 1 / (patch.peak_pressure * patch.half_width * now.wheel(side).compliance())};
            for (std::size_t m = 0; m < factors.size(); ++m) {
                of_wheel[m].add(patch.wheel_s, wear, factors[m] * at.distance / (2 * std::numbers::pi));
                of_rail[m].add(patch.rail_s, wear, factors[m] * at.passages);
            }
        }
        worst = std::max(worst, own);
        if (failure.empty() && (own == rollbem::Status::unbalanced || !has_numbers(own))) {
            failure = "row " + std::to_string(q + 1) + " of --positions, " + at.label() + ": " + name(own);
        }
    }
    status = name(worst);
    const auto rates = [](const std::array<rollbem::ProfileWear, 2>& sums, const Profile& profile,
                          const Eigen::ArrayXd& over) {
        const auto at = [&](std::size_t m) { return spread(profile, sums[m].at_points(profile) / over, reach); };
        return WearRates{at(0), at(1)};
    };
    return {rates(of_wheel, wheel.now, now.wheel(side).dimensions().radius + wheel.now.z()),
            rates(of_rail, rail.now, Eigen::ArrayXd::Ones(rail.now.size()))};
}

WearRow WearRun::State::row(double share) const {
    const auto worn_off = [](const WearingBody& body, const Profile& as_read) -> std::array<double, 3> {
        const double area = area_between(body.before, body.now, body.use);
        if (!(area > 0)) return {0, std::numeric_limits<double>::quiet_NaN(), 0};
        Eigen::Index at = 0;
        const double most = depth_between(body.before, body.now, body.use).maxCoeff(&at);
        return {most, as_read.y()[at], area};
    };
    return {share * distance,
            worn_off(wheel, wheel.now),
            worn_off(rail, rail.now.moved(plan.cant, 0, 0)),
            flange_sizes(wheel.now, plan.tape_offset),
            rail_wear(rail.before, rail.now, settings.wheelset.wheel(side).dimensions().gauge_depth),
            plan.rail,
            status};
}

void WearRun::State::run(const std::function<void(double part)>& done) {
    for (double share = 0;;) {
        const Rates rates = search();
        rows.push_back(row(share));
        if (!failure.empty() || share >= 1) return;
        double part = rates.wheel.part(plan.step);
        if (plan.rail) part = std::min(part, rates.rail.part(plan.step));
        if (part * most_searches < 1) {
            failure = "distances and passages must take at most 10000 searches, not " + study::Cell(1 / part).text(3) +
                      ": shorter distances [m], or a larger --wear-step";
            if (share == 0) throw study::BadInput("--positions: " + failure);
            return;
        }
        if (part > (1 - share) * (1 - 1e-9)) part = 1 - share;
        try {
            Profile next = wheel.after(rates.wheel.area, part);
            if (plan.rail) rail.wear(rail.after(rates.rail.area, part), rates.rail.area, part);
            wheel.wear(std::move(next), rates.wheel.area, part);
        } catch (const std::invalid_argument& fold) {
            failure = fold.what();
            return;
        }
        share = part < 1 - share ? share + part : 1;
        done(share);
    }
}

void WearRun::State::write(study::OutputFile* wheel_file, study::OutputFile* rail_file) const {
    const auto write = [](study::OutputFile* file, const Profile& profile) {
        if (file == nullptr) return;
        file->write("y,z\n");
        for (Eigen::Index i = 0; i < profile.size(); ++i) {
            file->write(study::csv_line({profile.y()[i], profile.z()[i]}));
        }
    };
    write(wheel_file, wheel.now);
    write(rail_file, rail.now.moved(plan.cant, 0, 0));
}

WearRun::WearRun(const Settings& settings) : state_(std::make_unique<State>(settings)) {}
WearRun::~WearRun() = default;

study::Table WearRun::table(study::OutputFiles& files) {
    State& state = *state_;
    static const study::Sheet<WearRow, Side> sheet = wear_sheet();
    study::Table table = sheet.table(
        state.settings.sides, [](Side) { return 1; },
        [&state](Side, study::RowRange, const study::Results<WearRow>& emit) {
            for (const WearRow& row : state.rows) emit(row);
        });
    const auto opened = [&](const std::string& path, const char* option) {
        return path.empty() ? nullptr : &files.open(path, option);
    };
    study::OutputFile* const wheel_file = opened(state.plan.worn_wheel, "--worn-wheel");
    study::OutputFile* const rail_file = opened(state.plan.worn_rail, "--worn-rail");
    table.prepare = [&state](const std::vector<std::size_t>&, const std::function<void(double)>& done) {
        state.run(done);
    };
    table.finish = [&state, wheel_file, rail_file] { state.write(wheel_file, rail_file); };
    table.label = [](std::size_t) { return "wear"; };
    table.ended = [&state](std::size_t) {
        return state.failure.empty()
                   ? ""
                   : "ended after " + study::Cell(state.rows.back().distance).text(6) + " m: " + state.failure;
    };
    table.plot = [&state](const study::Records&) {
        std::vector<Worn> drawn{{"Wheel", state.wheel.before, state.wheel.now, Use::wheel}};
        if (state.plan.rail) drawn.push_back({"Rail", state.rail.before, state.rail.now, Use::rail});
        return draw_wear(drawn);
    };
    return table;
}

}  // namespace profile
