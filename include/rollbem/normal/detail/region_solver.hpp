// The regions of one contact, each with a plane, a grid over the cells that may touch and gaps that hold for a height,
// and their pressures with the wheel a little lower or higher than that height.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../normal_contact.hpp"
#include "../wheel_on_rail.hpp"
#include "contact_gaps.hpp"
#include "contact_region.hpp"
#include "plane_patches.hpp"
#include "silhouette_search.hpp"
#include "slice_search.hpp"
#include "sufficient_cells.hpp"

namespace rollbem::detail {

/// The share of the displacement under one patch that acts on another one whose normal differs by an angle: 1 in one
/// plane. Fitted to finite elements of rail and wheel (docs/profiles.md).
inline double interaction(double angle) { return (std::max)(0.0, 1 - 1.4 * (1 - std::cos(angle))); }

/// Settings of a contact's solution.
struct ContactSettings {
    Eigen::Index cells_x, cells_s;
    double tolerance, cell_size;
    bool interaction, halves_cells;
};

/// The load [N] of a row of cells, its mean place in track axes [m], and the variance of its x [m^2].
struct RowLoad {
    double x, y, z, load, variance;
};

/// One region with its plane and its pressures.
struct SolvedRegion {
    ContactPlane plane{};
    std::size_t body = 0;  // regions of one body displace each other always
    NormalContact::Cells grid{};
    Gaps gaps{};  // gaps at the height of the plane
    NormalContact::Solution solution{};
    double vertical = 0;  // vertical load of the pressures [N]
    std::vector<RowLoad> rows{};
    Eigen::Index times_x = 1, times_s = 1;  // the usual numbers of cells are multiplied by these
    bool resolved = true;                   // cells suffice, as far as is known
};

class RegionSolver {
public:
    /// Starts a contact at a position, without its height.
    Status locate(const WheelOnRail::Geometry& geometry, const WheelsetPosition& at, const ContactSettings& settings) {
        geometry_ = &geometry;
        settings_ = settings;
        at_ = at;
        placed_.emplace(geometry.placed(at));
        regions_.clear();
        if (!normal_.empty() && normal_[0].compliance() != geometry.compliance()) normal_.clear();
        work_ = work_before_ = 0;
        return geometry.is_plain() ? silhouette_.locate(geometry, at) : slices_.locate(geometry, at);
    }

    double touch() const { return geometry_->is_plain() ? silhouette_.touch() : slices_.touch(); }
    bool is_too_deep() const { return geometry_->is_plain() ? silhouette_.is_too_deep() : slices_.is_too_deep(); }
    double height() const { return at_.height; }

    /// Doubles the numbers of cells, from the next refine() on, of regions where they do not suffice, in the directions
    /// that need it. Returns whether there are any; patches whose cells must not be doubled again have few_cells.
    bool double_cells() {
        if (!settings_.halves_cells || is_too_deep()) return false;
        const double work = work_ - std::exchange(work_before_, work_);
        bool any = false;
        for (std::size_t k = 0; k < regions_.size(); ++k) {
            if (!regions_[k].resolved) return false;
            any = double_cells(k, work) || any;
            if (!regions_[k].resolved) return false;
        }
        return any;
    }

    /// Finds the regions of the contact at a height, and their loads on coarse grids.
    void divide(double height) {
        at_.height = height;
        // regions that join or split have the cells of the finest
        Eigen::Index times_x = 1, times_s = 1;
        bool resolved = true;
        for (const SolvedRegion& region : regions_) {
            times_x = (std::max)(times_x, region.times_x);
            times_s = (std::max)(times_s, region.times_s);
            resolved = resolved && region.resolved;
        }
        regions_.clear();
        for (const Region& found : find_regions(height)) {
            SolvedRegion& region = regions_.emplace_back();
            region.times_x = times_x;
            region.times_s = times_s;
            region.resolved = resolved;
            region.plane = plane_of(*geometry_, found, at_.along);
            region.body = found.body;
            region.grid = first_grid(region);
            find_gaps(region);
        }
        while (normal_.size() < regions_.size()) normal_.emplace_back(geometry_->compliance());
        settle(0, 1e-3, false);
    }

    /// Makes fine grids over the cells that may touch, and planes, at a height. Rounds: the first follows divide(), and
    /// the first two make grids anew. If regions have joined or split meanwhile and `divides` is set, they are
    /// found anew; returns the resulting number of the round.
    int refine(double height, int round, bool divides, bool anew) {
        std::vector<Region> found = find_regions(height);
        if (found.size() != regions_.size() && divides) {
            divide(height);
            round = 0;
        }
        const double fallen = height - at_.height;
        at_.height = height;
        if (round == 0) keep_touching();
        const bool same = round > 0 && found.size() == regions_.size();
        if (same) match(found);
        for (std::size_t k = 0; k < regions_.size(); ++k) {
            SolvedRegion& region = regions_[k];
            const bool touches = region.solution.load > 0;
            if (touches && (round < 2 || anew || outgrown(k))) region.grid = finer(k);
            if (same) {
                const ContactPlane before = std::exchange(region.plane, plane_of(*geometry_, found[k], at_.along));
                region.body = found[k].body;
                region.grid.x_0 += before.x - region.plane.x;  // the grid stays where it is
                region.grid.y_0 -= before.s(region.plane.y, region.plane.z);
            } else if (round > 0) {
                region.plane.deepest += fallen * region.plane.cosine;
            }
            if (settings_.cell_size > 0) {
                region.grid.x_0 = region.grid.dx * std::round(region.grid.x_0 / region.grid.dx);
                region.grid.y_0 = region.grid.dy * std::round(region.grid.y_0 / region.grid.dy);
            }
            find_gaps(region);
        }
        return round;
    }

    /// Finds loads with the wheel lower than its gaps assume, in rounds, as each region displaces the surface below the
    /// others.
    void settle(double lower, double tolerance, bool warm) {
        const int rounds = interact() ? 4 : 1;
        for (int round = 0; round < rounds; ++round) {
            for (std::size_t k = 0; k < regions_.size(); ++k) {
                SolvedRegion& region = regions_[k];
                const double depth = lower * region.plane.cosine;
                const NormalContact::Grid& h = rounds > 1 ? displaced(k) : region.gaps.h;
                region.solution = normal_[k].approach(region.grid, h, depth, tolerance, warm || round > 0);
                note_work(region);
                region.vertical = vertical_load(k);
                if (rounds > 1) find_rows(k);
            }
        }
    }

    /// The distance by which the wheel must be lower than its gaps assume to carry a vertical load [N]; nothing if it
    /// was not found. `tolerance`: relative error of the load, and of gaps over the approach.
    std::optional<double> lower_until(double load, double tolerance) {
        if (regions_.empty()) return std::nullopt;
        if (regions_.size() == 1) {
            constexpr double wall = 1e-3;  // a cosine: surfaces as steep as this carry nothing
            SolvedRegion& region = regions_[0];
            if (!(region.plane.cosine > wall)) return std::nullopt;
            // normals turn across the patch, so that the vertical share of the pressures depends a little on the load
            const double share = region.vertical > 0 ? region.vertical / region.solution.load : region.plane.cosine;
            double normal = load / share, last = 0, before = 0, rate = 1;
            for (int k = 0; k < 12; ++k) {
                region.solution = normal_[0].carry(region.grid, region.gaps.h, normal, tolerance, true);
                note_work(region);
                region.vertical = vertical_load(0);
                const double missing = std::log(load / region.vertical);
                if (!is_finite(missing) || std::abs(missing) < tolerance) break;
                if (k > 0) rate = std::clamp((before - missing) / std::log(normal / last), 0.3, 3.0);
                before = missing;
                last = std::exchange(normal, normal * std::exp(missing / rate));
            }
            return region.solution.approach / region.plane.cosine;
        }
        // the power 2/3 of a load grows nearly linearly
        const auto root = [](double of) { return std::cbrt(of * of); };
        double lower = 0, low = -std::numeric_limits<double>::infinity(), high = -low, last = 0, value = 0;
        for (int k = 0; k < 60; ++k) {
            settle(lower, tolerance / 10, true);
            const double found = carried();
            if (std::abs(found / load - 1) < tolerance) return lower;
            (found < load ? low : high) = lower;
            const double rate = k == 0 ? root(found) / deepest() : (root(found) - value) / (lower - last);
            last = lower;
            value = root(found);
            lower += (root(load) - value) / rate;
            if (!(lower > low && lower < high)) {
                lower = is_finite(high - low) ? (low + high) / 2 : last + (found < load ? 1 : -1) * deepest();
            }
        }
        return std::nullopt;
    }

    /// The vertical load of all regions [N].
    double carried() const {
        double sum = 0;
        for (const SolvedRegion& region : regions_) sum += region.vertical;
        return sum;
    }
    double deepest() const {
        double most = 0;
        for (const SolvedRegion& region : regions_) most = (std::max)(most, region.plane.deepest);
        return most;
    }

    /// Whether pressure reaches the border of a grid.
    bool outgrown() const {
        for (std::size_t k = 0; k < regions_.size(); ++k) {
            if (outgrown(k)) return true;
        }
        return false;
    }

    /// Patches by decreasing load, with the wheel lower than its gaps assume.
    std::vector<RailPatch> patches(double lower) const {
        const double negligible = negligible_load();
        std::vector<RailPatch> found;
        for (std::size_t k = 0; k < regions_.size(); ++k) {
            const SolvedRegion& region = regions_[k];
            if (!(region.solution.load > 0)) continue;
            add_patches(*geometry_, at_,
                        {region.plane, region.grid, region.gaps, region.solution, normal_[k].pressure(),
                         lower * region.plane.cosine, is_resolved(region)},
                        negligible, found);
        }
        std::stable_sort(found.begin(), found.end(),
                         [](const RailPatch& one, const RailPatch& other) { return one.load > other.load; });
        return found;
    }

private:
    // The load of a patch [N] below which it may have too few cells.
    double negligible_load() const {
        constexpr double share = 1e-3;  // of the normal forces
        double load = 0;
        for (const SolvedRegion& region : regions_) load += region.solution.load;
        return share * load;
    }

    // Pressures that do not settle on halved cells need more cells than can be solved for.
    static bool is_resolved(const SolvedRegion& of) {
        const bool halved = of.times_x * of.times_s > 1;
        return of.resolved && !(halved && of.solution.status == Status::not_converged);
    }

    void note_work(const SolvedRegion& of) { work_ += double(of.solution.steps) * double(of.grid.nx * of.grid.ny); }

    // `work`: that of the present cells.
    bool double_cells(std::size_t k, double work) {
        // cells times steps of a contact, some tenths of a second; those after a doubling are estimated. Where the
        // waves of two rough profiles meet is an accident of the position: worth less.
        constexpr double rounds = 3;
        const double most_work = geometry_->is_rough() ? 5e5 : 5e6;
        SolvedRegion& region = regions_[k];
        const NormalContact::Grid& p = normal_[k].pressure();
        // no cells resolve pressures that end where a surface does
        if (!(region.solution.load > 0) || border_of(region.gaps, p) != Status::ok) return false;
        MoreCells wanted = cells_for_outlines(region.grid, p, negligible_load());
        if (!wanted && settings_.cell_size == 0) wanted = cells_for_pressures(k);
        if (!wanted) return false;
        if (settings_.cell_size > 0) wanted = {2, 2};
        region.resolved = work_ + rounds * double(wanted.x * wanted.s) * work < most_work;
        if (!region.resolved) return false;
        region.times_x *= wanted.x;
        region.times_s *= wanted.s;
        return true;
    }

    // More cells in the directions in which they are too large: where pressures on cells twice as large differ too
    // much, or waves lie between their centres.
    MoreCells cells_for_pressures(std::size_t k) {
        const SolvedRegion& region = regions_[k];
        const NormalContact::Grid& h = interact() ? displaced(k) : region.gaps.h;
        const double counted = 20 * negligible_load();
        const auto by = [&](Eigen::Index every_x, Eigen::Index every_s) {
            return change_by_larger_cells(coarse_, region.grid, h, region.solution, normal_[k].pressure(),
                                          geometry_->compliance(), counted, every_x, every_s);
        };
        const MoreCells for_waves{times_for_waves(k, true), times_for_waves(k, false)};
        if (for_waves) return for_waves;
        if (by(2, 2) < 1) return {};
        const bool by_x = by(2, 1) > by(1, 2);
        return {by_x ? 2 : 1, by_x ? 1 : 2};
    }

    // How many times as many cells along x or s miss no waves of the gap on the line through the largest pressure.
    Eigen::Index times_for_waves(std::size_t k, bool along_x) {
        constexpr Eigen::Index few = 4, many = 32;
        return times_for_waves(k, along_x, few) == 1 ? 1 : times_for_waves(k, along_x, many);
    }
    Eigen::Index times_for_waves(std::size_t k, bool along_x, Eigen::Index parts) {
        const SolvedRegion& region = regions_[k];
        const NormalContact::Cells& grid = region.grid;
        const NormalContact::Grid& p = normal_[k].pressure();
        Eigen::Index i = 0, j = 0;
        p.maxCoeff(&i, &j);
        NormalContact::Cells line = grid;
        line.nx = along_x ? parts * (grid.nx - 1) + 1 : 1;
        line.ny = along_x ? 1 : parts * (grid.ny - 1) + 1;
        (along_x ? line.y_0 : line.x_0) = along_x ? grid.y(j) : grid.x(i);
        (along_x ? line.dx : line.dy) /= double(parts);
        finder_.find(*geometry_, *placed_, at_.height, at_.along, region.plane, line, row_);
        const Eigen::ArrayXd h = row_.h.reshaped(), pressures = along_x ? p.col(j).eval() : p.row(i).transpose().eval();
        return WavesMissed{h, pressures, parts, along_x ? grid.dx : grid.dy, geometry_->compliance()}.times();
    }

    std::vector<Region> find_regions(double height) {
        return geometry_->is_plain() ? silhouette_.regions(height) : slices_.regions(height);
    }

    double vertical_load(std::size_t k) const {
        const SolvedRegion& region = regions_[k];
        if (!(region.solution.load > 0)) return 0;
        return detail::vertical_load(normal_[k].pressure(), region.grid, region.gaps.rail_slope, region.plane.angle);
    }

    void find_gaps(SolvedRegion& region) {
        finder_.find(*geometry_, *placed_, at_.height, at_.along, region.plane, region.grid, region.gaps);
    }

    // Whether regions displace each other: by choice those of different bodies, always those of one.
    bool interact() const {
        if (settings_.interaction) return regions_.size() > 1;
        for (std::size_t k = 0; k < regions_.size(); ++k) {
            for (std::size_t other = 0; other < k; ++other) {
                if (regions_[k].body == regions_[other].body) return true;
            }
        }
        return false;
    }

    // The gaps of region k plus displacements by the loads of the others.
    const NormalContact::Grid& displaced(std::size_t k) {
        const SolvedRegion& region = regions_[k];
        displaced_ = region.gaps.h;
        find_loads_on(k);
        for (const PointLoad& load : loads_) {
            for (Eigen::Index j = 0; j < region.grid.ny; ++j) {
                const double s = load.s + region.grid.y(j), square = s * s + load.n * load.n;
                for (Eigen::Index i = 0; i < region.grid.nx; ++i) {
                    const double x = load.x + region.grid.x(i);
                    displaced_(i, j) += load.size / std::sqrt((std::max)(x * x + square, 1e-12));
                }
            }
        }
        return displaced_;
    }

    // A load on another region, seen from the plane of one: minus its x and s, its distance from the plane, and its
    // displacement times the distance.
    struct PointLoad {
        double x, s, n, size;
    };

    // Loads that displace region k: of another body as if it acted at the plane's origin, of the same body in each row
    // of cells, as these regions are as wide as far apart.
    void find_loads_on(std::size_t k) {
        loads_.clear();
        const ContactPlane& here = regions_[k].plane;
        for (std::size_t other = 0; other < regions_.size(); ++other) {
            const SolvedRegion& region = regions_[other];
            const ContactPlane& there = region.plane;
            const bool same = region.body == regions_[k].body;
            if (other == k || !(settings_.interaction || same)) continue;
            const double size = interaction(here.angle - there.angle) * geometry_->compliance() / std::numbers::pi;
            if (size * region.solution.load == 0) continue;
            if (!same) {
                loads_.push_back({here.x - there.x, -here.s(there.y, there.z), here.n(there.y, there.z),
                                  region.solution.load * size});
                continue;
            }
            for (const RowLoad& row : region.rows) {
                // the mean inverse distance of the row from a point beside it, to second order in its length
                loads_.push_back({here.x - row.x, -here.s(row.y, row.z),
                                  std::hypot(here.n(row.y, row.z), std::sqrt(row.variance)), row.load * size});
            }
        }
    }

    // The loads of a region's rows of cells, after a solution.
    void find_rows(std::size_t k) {
        SolvedRegion& region = regions_[k];
        const ContactPlane& plane = region.plane;
        const NormalContact::Cells& grid = region.grid;
        const NormalContact::Grid& p = normal_[k].pressure();
        const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(grid.nx, grid.x(0), grid.x(grid.nx - 1));
        region.rows.clear();
        for (Eigen::Index j = 0; j < grid.ny; ++j) {
            const double sum = p.col(j).sum(), s = grid.y(j), n = region.gaps.rail_n[j];
            if (!(sum > 0)) continue;
            const double mean = (p.col(j) * x).sum() / sum;
            region.rows.push_back({plane.x + mean, plane.y + s * plane.cosine - n * plane.sine,
                                   plane.z + s * plane.sine + n * plane.cosine, sum * grid.dx * grid.dy,
                                   (p.col(j) * (x - mean).square()).sum() / sum});
        }
    }

    NormalContact::Cells first_grid(const SolvedRegion& region) {
        const ContactPlane& plane = region.plane;
        // finer grids lie where these cells find pressure, which a narrow lobe between their centres would not have
        const Eigen::Index nx = 24, ny = has_narrow_lobe(region) ? 60 : nx;
        constexpr double least = 2e-6;
        const double half = (std::max)(1.1 * (plane.x_high - plane.x_low) / 2, least);
        const double height = (std::max)(1.04 * (plane.high - plane.low), least);
        const double dx = 2 * half / double(nx), dy = height / double(ny), middle = (plane.x_low + plane.x_high) / 2;
        return {nx, ny, middle - half + dx / 2, (plane.low + plane.high - height + dy) / 2, dx, dy};
    }

    // Grid over the cells that may touch, with a margin of two cells.
    NormalContact::Cells finer(std::size_t k) {
        const SolvedRegion& region = regions_[k];
        const auto [left, right, bottom, top] = extents(region.grid, normal_[k].pressure());
        constexpr Eigen::Index margin = 2, most = 60;
        if (const double size = settings_.cell_size / double(region.times_x); size > 0) {
            const auto count = [=](double length) { return Eigen::Index(std::ceil(length / size)) + 2 * margin + 2; };
            return {count(right - left),
                    count(top - bottom),
                    (std::floor(left / size) - margin) * size,
                    (std::floor(bottom / size) - margin) * size,
                    size,
                    size};
        }
        // lines across the track end where profiles have edges
        constexpr double line = 10;
        const bool lobes = top - bottom > line * (right - left) || has_lobes(region);
        const Eigen::Index nx = settings_.cells_x * region.times_x,
                           ny = (lobes ? (std::max)(settings_.cells_s, most) : settings_.cells_s) * region.times_s;
        // a contact that reached the border has grown by more than two of many cells
        const auto beside = [&](Eigen::Index count) { return outgrown(k) ? (std::max)(margin, count / 16) : margin; };
        const Eigen::Index beside_x = beside(nx), beside_s = beside(ny);
        const double dx = (right - left) / double(nx - 2 * beside_x), dy = (top - bottom) / double(ny - 2 * beside_s);
        return {nx, ny, left + (0.5 - double(beside_x)) * dx, bottom + (0.5 - double(beside_s)) * dy, dx, dy};
    }

    // The gap in 80 places across a plane; none of a plane without width.
    Eigen::ArrayXd gap_across(const ContactPlane& plane) {
        constexpr Eigen::Index count = 80;
        const double ds = (plane.high - plane.low) / count;
        if (!(ds > 0)) return {};
        finder_.find(*geometry_, *placed_, at_.height, at_.along, plane, {1, count, 0, plane.low + ds / 2, ds, ds},
                     row_);
        return row_.h.row(0);
    }

    // Whether a lobe of the gap is narrower, half-way up to the ridge beside it, than a tenth of the plane.
    bool has_narrow_lobe(const SolvedRegion& region) {
        const Eigen::ArrayXd h = gap_across(region.plane);
        const Eigen::Index count = h.size(), narrow = count / 10;
        const double distinct = count > 0 ? -h.minCoeff() / 200 : 0;
        for (Eigen::Index at = 0; at < count; ++at) {
            double ridge = std::numeric_limits<double>::infinity();
            for (const Eigen::Index step : {-1, 1}) {
                double highest = h[at];
                for (Eigen::Index j = at + step; j >= 0 && j < count && h[j] >= h[at]; j += step)
                    highest = (std::max)(highest, h[j]);
                ridge = (std::min)(ridge, highest);
            }
            if (!(ridge - h[at] > distinct)) continue;
            Eigen::Index low = at, high = at;
            while (low > 0 && h[low - 1] < (ridge + h[at]) / 2) --low;
            while (high + 1 < count && h[high + 1] < (ridge + h[at]) / 2) ++high;
            if (high - low < narrow) return true;
        }
        return false;
    }

    // Whether cells are too few for the narrowest lobe of the gap, or there are several lobes.
    bool has_lobes(const SolvedRegion& region) {
        constexpr Eigen::Index least_cells = 10;
        const Eigen::ArrayXd h = gap_across(region.plane);
        const Eigen::Index count = h.size();
        if (count == 0) return false;
        // across the deepest lobe: a parabola has half its width where the gap has risen by a quarter
        Eigen::Index deepest = 0;
        const double least = h.minCoeff(&deepest);
        Eigen::Index low = deepest, high = deepest;
        while (low > 0 && h[low - 1] < 0.75 * least) --low;
        while (high + 1 < count && h[high + 1] < 0.75 * least) ++high;
        if (double(high - low + 1) / double(count) * 2 * double(settings_.cells_s * region.times_s) < least_cells)
            return true;
        // another lobe, deeper than the ridge between the two
        for (const Eigen::Index step : {-1, 1}) {
            double ridge = least;
            for (Eigen::Index j = deepest + step; j >= 0 && j < count; j += step) {
                ridge = (std::max)(ridge, h[j]);
                if (h[j] < ridge + least / 200) return true;
            }
        }
        return false;
    }

    // Keeps only regions with a load, and the memory of their pressures.
    void keep_touching() {
        std::vector<SolvedRegion> touching;
        for (std::size_t k = 0; k < regions_.size(); ++k) {
            if (!(regions_[k].solution.load > 0)) continue;
            std::swap(normal_[touching.size()], normal_[k]);
            touching.push_back(std::move(regions_[k]));
        }
        regions_ = std::move(touching);
    }

    // Sorts found regions in the order of the present ones nearest to them.
    void match(std::vector<Region>& found) const {
        for (std::size_t k = 0; k + 1 < regions_.size(); ++k) {
            std::size_t nearest = k;
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t i = k; i < found.size(); ++i) {
                const double distance = plane_of(*geometry_, found[i], at_.along).distance(regions_[k].plane);
                if (distance < least) nearest = i;
                least = (std::min)(least, distance);
            }
            std::swap(found[k], found[nearest]);
        }
    }

    bool outgrown(std::size_t k) const {
        const NormalContact::Grid& p = normal_[k].pressure();
        if (p.size() == 0) return false;
        const Eigen::Index right = p.rows() - 1, top = p.cols() - 1;
        return (p.row(0) > 0).any() || (p.row(right) > 0).any() || (p.col(0) > 0).any() || (p.col(top) > 0).any();
    }

    const WheelOnRail::Geometry* geometry_ = nullptr;
    ContactSettings settings_{};
    WheelsetPosition at_;
    std::optional<WheelSurface::Placed> placed_;
    SilhouetteSearch silhouette_;
    SliceSearch slices_;
    GapFinder finder_;
    Gaps row_;
    NormalContact::Grid displaced_;
    std::vector<PointLoad> loads_;
    std::vector<SolvedRegion> regions_;
    std::vector<NormalContact> normal_;  // normal problems of the regions
    NormalContact coarse_{1};            // on cells twice as large
    double work_ = 0, work_before_ = 0;  // cells times steps of this contact, and those before the present cells
};

}  // namespace rollbem::detail
