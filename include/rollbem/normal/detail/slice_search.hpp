// Contacts of a wheel on a rail of which at least one changes along the way: the smallest gaps over slices of constant
// x, and the regions about them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "../../detail/finite.hpp"
#include "../../status.hpp"
#include "contact_region.hpp"
#include "curve_index.hpp"
#include "rail_samples.hpp"

namespace rollbem::detail {

/// A search at one lateral position, roll, yaw, pitch and place along the track; used as SilhouetteSearch.
class SliceSearch {
public:
    Status locate(const WheelOnRail::Geometry& geometry, const WheelsetPosition& at) {
        geometry_ = &geometry;
        track_x_ = at.along;
        placed_.emplace(geometry.placed(at));
        find_slices();
        touch_ = std::numeric_limits<double>::infinity();
        for (const Slice& slice : slices_) {
            for (const SurfaceSample& sample : slice.wheel) {
                touch_ = (std::min)(touch_, slice.rail.top(sample.y) - sample.z);
            }
        }
        if (!is_finite(touch_)) return Status::no_contact;
        find_deepest_points(touch_);
        bool found = false;
        touch_ = touching_height(touch_, [&](double height) {
            const ClosestPoint* deepest = nullptr;
            for (Point& point : deepest_points_) {
                descend(point, height);
                if (deepest == nullptr || point.closest.depth > deepest->depth) deepest = &point.closest;
            }
            found = deepest != nullptr && is_finite(deepest->depth);
            return found ? deepest : nullptr;
        });
        if (!found) return Status::undefined_section;
        keep_different();
        return Status::ok;
    }

    double touch() const { return touch_; }

    bool is_too_deep() const {
        constexpr double most = 1e-3;
        for (const Slice& slice : slices_) {
            for (const SurfaceSample& sample : slice.wheel) {
                const double z = sample.z + height_, below = z - slice.rail.top(sample.y);
                if (!(below > most)) continue;
                const SurfaceSample* rail = slice.rail.facing(sample.y, z, sample.normal_y, sample.normal_z);
                if (rail == nullptr) return true;
                if (closest_on_rail(*geometry_, rail->s, track_x_ + slice.x, sample.y, z).depth > most) {
                    return true;
                }
            }
        }
        return false;
    }

    std::vector<Region> regions(double height) {
        height_ = height;
        // points that lay too high above the rail may touch now
        if (height - deepest_at_ > seen_above / 2) {
            find_deepest_points(height);
            for (Point& point : deepest_points_) descend(point, height);
            keep_different();
        }
        std::vector<Region> found;
        for (const Point& point : deepest_points_) {
            Point seed = point;
            descend(seed, height);
            if (!(seed.closest.depth > 0) || lies_in(found, seed)) continue;
            std::size_t body = found.size();  // regions are not fewer than bodies
            for (Region& region : explore(seed, height)) {
                region.body = body;
                body = join(found, std::move(region));
            }
        }
        return found;
    }

private:
    static constexpr double slice_distance = 4e-3;  // along x [m]
    static constexpr double seen_above = 1e-3;      // largest height of points above the rail [m]

    struct Slice {
        double x;
        CurveIndex rail;
        std::vector<SurfaceSample> wheel;
    };
    // A point of the wheel and the closest point of the rail.
    struct Point {
        double x, s, y, z;
        ClosestPoint closest;
        bool defined;
    };

    void find_slices() {
        constexpr double distance = 2e-4;
        const auto half = static_cast<int>(placed_->reach_x() / slice_distance);
        slices_.resize(std::size_t(2 * half + 1));
        const WheelSurface& wheel = placed_->surface();
        for (int k = -half; k <= half; ++k) {
            Slice& slice = slices_[std::size_t(k + half)];
            slice.x = placed_->middle_x() + k * slice_distance;
            slice.rail.build(rail_samples(*geometry_, track_x_ + slice.x));
            slice.wheel.clear();
            const auto count = static_cast<std::size_t>(std::ceil(wheel.length() / distance));
            for (std::size_t i = 0; i <= count; ++i) {
                const double s = wheel.length() * double(i) / double(count);
                const RailSurface::Point p = placed_->section(s, slice.x);
                const double size = std::hypot(p.slope[0], p.slope[1]);
                if (p.defined) slice.wheel.push_back({p.y, p.z, -p.slope[1] / size, p.slope[0] / size, s});
            }
        }
    }

    // Finds points of slices that lie at least as deep as their neighbours on the wheel and in both adjacent slices,
    // and less than a millimetre above the rail at this height.
    void find_deepest_points(double height) {
        constexpr double none = -std::numeric_limits<double>::infinity();
        deepest_at_ = height;
        std::vector<std::vector<Point>> points(slices_.size());
        for (std::size_t k = 0; k < slices_.size(); ++k) {
            const Slice& slice = slices_[k];
            for (const SurfaceSample& sample : slice.wheel) {
                const double z = sample.z + height;
                Point& p = points[k].emplace_back(Point{slice.x, sample.s, sample.y, z, {}, true});
                p.closest.depth = none;
                if (z - slice.rail.top(sample.y) < -seen_above - CurveIndex::reach) continue;
                const SurfaceSample* rail = slice.rail.facing(sample.y, z, sample.normal_y, sample.normal_z);
                if (rail == nullptr) continue;
                p.closest = closest_on_rail(*geometry_, rail->s, track_x_ + slice.x, sample.y, z);
                if (!p.closest.inside) p.closest.depth = none;
            }
        }
        deepest_points_.clear();
        for (std::size_t k = 0; k < points.size(); ++k) {
            for (std::size_t i = 0; i < points[k].size(); ++i) {
                const Point& p = points[k][i];
                if (!(p.closest.depth > -seen_above)) continue;
                // on a plateau, the first point
                const auto deeper = [&](const Point& other) {
                    const bool first = other.x < p.x || (other.x == p.x && other.s < p.s);
                    return other.closest.depth > p.closest.depth + (first ? -1e-12 : 1e-12) &&
                           std::hypot(other.y - p.y, other.z - p.z) < 1e-3;
                };
                bool is_deepest =
                    !(i > 0 && deeper(points[k][i - 1])) && !(i + 1 < points[k].size() && deeper(points[k][i + 1]));
                for (const std::size_t beside : {k - 1, k + 1}) {
                    if (!is_deepest || beside >= points.size()) continue;
                    is_deepest = std::none_of(points[beside].begin(), points[beside].end(), deeper);
                }
                if (is_deepest) deepest_points_.push_back(p);
            }
        }
        std::sort(deepest_points_.begin(), deepest_points_.end(),
                  [](const Point& one, const Point& two) { return one.closest.depth > two.closest.depth; });
    }

    // Keeps one of the deepest points that have met.
    void keep_different() {
        std::vector<Point> kept;
        for (const Point& point : deepest_points_) {
            const bool known = std::any_of(kept.begin(), kept.end(), [&](const Point& other) {
                return std::hypot(point.x - other.x, point.y - other.y, point.z - other.z) < 2e-4;
            });
            if (!known && is_finite(point.closest.depth)) kept.push_back(point);
        }
        deepest_points_ = std::move(kept);
    }

    Point point_at(const Point& from, double x, double s, double height) const {
        Point p = from;
        p.x = x;
        p.s = s;
        const RailSurface::Point on_wheel = placed_->section(s, x);
        p.y = on_wheel.y;
        p.z = on_wheel.z + height;
        p.defined = on_wheel.defined && s >= 0 && s <= placed_->surface().length();
        if (!p.defined) return p;
        p.closest = closest_on_rail(*geometry_, from.closest.s, track_x_ + x, p.y, p.z);
        p.defined = p.closest.inside;
        return p;
    }

    // Moves a point to the deepest point nearby, by parabolas along the wheel's curve and along x.
    void descend(Point& p, double height) const {
        p = point_at(p, p.x, p.s, height);
        double step_s = 2e-4, step_x = 2e-3;
        for (int k = 0; k < 60 && step_s > 1e-6; ++k) {
            const Point start = p;
            for (const bool along_x : {false, true}) {
                const double step = along_x ? step_x : step_s;
                const auto beside = [&](double by) {
                    return point_at(p, p.x + (along_x ? by : 0), p.s + (along_x ? 0 : by), height);
                };
                const Point one = beside(-step), two = beside(step);
                Point best = p;
                if (one.defined && two.defined && p.defined) {
                    const double bend = one.closest.depth - 2 * p.closest.depth + two.closest.depth,
                                 to = bend < 0
                                          ? std::clamp((one.closest.depth - two.closest.depth) / (2 * bend), -1.0, 1.0)
                                          : 0;
                    const Point vertex = beside(to * step);
                    if (vertex.defined && vertex.closest.depth > best.closest.depth) best = vertex;
                }
                for (const Point& other : {one, two}) {
                    if (other.defined && (!best.defined || other.closest.depth > best.closest.depth)) best = other;
                }
                p = best;
            }
            if (std::abs(p.s - start.s) < step_s && std::abs(p.x - start.x) < step_x) {
                step_s /= 3;
                step_x /= 3;
            }
        }
        if (!p.defined) p.closest.depth = -std::numeric_limits<double>::infinity();
    }

    static bool lies_in(const std::vector<Region>& found, const Point& p) {
        for (const Region& region : found) {
            for (const PenetrationSample& sample : region.samples) {
                if (sample.closest.depth > 0 && std::hypot(sample.x - p.x, sample.y - p.y, sample.z - p.z) < 1.5e-3 &&
                    std::abs(sample.closest.angle() - p.closest.angle()) < joined_angle) {
                    return true;
                }
            }
        }
        return false;
    }

    // Adds the samples at x about a point of the region, outwards along the wheel, until the wheel stays above the rail
    // for a while, or what lies below the rail beyond a gap has another normal. Returns the ends of the overlap on the
    // wheel's curve, nothing if there is none. `step` [m] is the distance between samples.
    std::optional<std::array<double, 2>> sample_slice(const Point& about, double step, double height,
                                                      std::vector<PenetrationSample>& samples) const {
        const double length = placed_->surface().length();
        std::vector<PenetrationSample> slice;
        for (const int direction : {-1, 1}) {
            Point p = about;
            double last = p.s, stride = step, angle = p.closest.angle();
            bool gap = false;
            if (direction > 0) p = point_at(p, p.x, p.s + stride, height);
            while (std::abs(p.s - last) < joined_distance / 2 && p.s >= 0 && p.s <= length) {
                const bool below = p.defined && p.closest.depth > 0;
                if (below && gap && std::abs(p.closest.angle() - angle) >= joined_angle) break;
                gap = !below;
                slice.push_back({p.s, p.x, p.y, p.z, p.closest, 0});
                if (!below) slice.back().closest.depth = 0;
                if (below) {
                    last = p.s;
                    angle = p.closest.angle();
                }
                stride = below ? step : (std::max)(step, (std::min)(1.2 * stride, 1e-4));
                p = point_at(p, p.x, p.s + direction * stride, height);
            }
            if (direction < 0) std::reverse(slice.begin(), slice.end());
        }
        std::optional<std::array<double, 2>> range;
        for (std::size_t k = 0; k < slice.size(); ++k) {
            const PenetrationSample &before = slice[k > 0 ? k - 1 : 0],
                                    &after = slice[(std::min)(k + 1, slice.size() - 1)];
            if (!(slice[k].closest.depth > 0)) continue;
            slice[k].width = (std::max)(after.y - before.y, 0.0);
            if (!range) range = {slice[k].wheel_s, slice[k].wheel_s};
            (*range)[1] = slice[k].wheel_s;
            samples.push_back(slice[k]);
        }
        return range;
    }

    // The regions about a point: one, or one for each of several contacts.
    std::vector<Region> explore(const Point& seed, double height) const {
        Region region;
        region.power = 2;
        // A tenth of the half-length, as estimated from the wheel's radius, and a fortieth of the width.
        const double step_x = std::clamp(std::sqrt(2 * seed.closest.depth * placed_->radius()) / 10, 2e-6, 1e-3);
        double step_s = 5e-5;
        for (int k = 0; k < 2; ++k) {
            region.samples.clear();
            const auto range = sample_slice(seed, step_s, height, region.samples);
            if (!range) return {};
            step_s = std::clamp(((*range)[1] - (*range)[0]) / 40, 1e-6, 2.5e-4);
        }
        for (const int direction : {-1, 1}) {
            Point about = seed;
            for (int k = 1; k < 400; ++k) {
                const double x = seed.x + direction * k * step_x;
                about = point_at(about, x, about.s, height);
                const auto range = sample_slice(about, step_s, height, region.samples);
                if (!range) break;
                about = point_at(about, x, ((*range)[0] + (*range)[1]) / 2, height);
            }
        }
        for (PenetrationSample& sample : region.samples) sample.width *= step_x;
        std::vector<Region> regions;
        split(std::move(region), step_x, regions);
        return regions;
    }

    // Splits a region at changes of its normal; `step_x` [m] is the distance between slices.
    static void split(Region region, double step_x, std::vector<Region>& regions) {
        const std::vector<PenetrationSample> ridge = ridge_of(region.samples);
        const auto at = find_split(ridge.begin(), ridge.end());
        if (at != ridge.end()) {
            Region beyond = region;
            std::erase_if(beyond.samples,
                          [&](const PenetrationSample& sample) { return sample.wheel_s < at->wheel_s; });
            std::erase_if(region.samples,
                          [&](const PenetrationSample& sample) { return sample.wheel_s >= at->wheel_s; });
            region.rail.high = beyond.rail.low = at->closest.s;
            split(std::move(region), step_x, regions);
            split(std::move(beyond), step_x, regions);
            return;
        }
        const auto [low, high] = std::minmax_element(
            region.samples.begin(), region.samples.end(),
            [](const PenetrationSample& one, const PenetrationSample& other) { return one.x < other.x; });
        region.x_low = low->x - step_x;
        region.x_high = high->x + step_x;
        regions.push_back(std::move(region));
    }

    // The deepest sample of each tenth of a millimetre along the wheel's curve.
    static std::vector<PenetrationSample> ridge_of(std::vector<PenetrationSample> samples) {
        constexpr double distance = 1e-4;
        const auto place = [](const PenetrationSample& sample) { return std::floor(sample.wheel_s / distance); };
        std::sort(samples.begin(), samples.end(), [&](const PenetrationSample& one, const PenetrationSample& other) {
            return std::pair(place(one), -one.closest.depth) < std::pair(place(other), -other.closest.depth);
        });
        samples.erase(std::unique(samples.begin(), samples.end(),
                                  [&](const PenetrationSample& one, const PenetrationSample& other) {
                                      return place(one) == place(other);
                                  }),
                      samples.end());
        return samples;
    }

    static double angle_of(const Region& region) {
        return mean_angle(region.samples.begin(), region.samples.end(), region.power);
    }

    // Joins a region to one that is near and has nearly the same normal, or adds it. Returns its body.
    static std::size_t join(std::vector<Region>& found, Region region) {
        for (Region& other : found) {
            double least = std::numeric_limits<double>::infinity();
            for (const PenetrationSample& one : other.samples) {
                for (const PenetrationSample& two : region.samples) {
                    if (std::abs(one.wheel_s - two.wheel_s) > joined_distance) continue;
                    least = (std::min)(least, std::hypot(one.x - two.x, one.y - two.y, one.z - two.z));
                }
            }
            if (least >= joined_distance || std::abs(angle_of(other) - angle_of(region)) >= joined_angle) continue;
            other.samples.insert(other.samples.end(), region.samples.begin(), region.samples.end());
            other.x_low = (std::min)(other.x_low, region.x_low);
            other.x_high = (std::max)(other.x_high, region.x_high);
            for (Region& of : found) of.body = of.body == region.body ? other.body : of.body;
            return other.body;
        }
        found.push_back(std::move(region));
        return found.back().body;
    }

    const WheelOnRail::Geometry* geometry_ = nullptr;
    std::optional<WheelSurface::Placed> placed_;
    double track_x_ = 0, touch_ = 0, height_ = 0;
    double deepest_at_ = 0;  // height at which deepest points were searched
    std::vector<Slice> slices_;
    std::vector<Point> deepest_points_;
};

}  // namespace rollbem::detail
