// Contacts of a wheel on a rail of which at least one changes along the way: the smallest gaps over slices of constant
// x, and the regions about them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "../../status.hpp"
#include "contact_region.hpp"

namespace rollbem::detail {

/// A search at one lateral position, roll, yaw, pitch and place along the track; used as SilhouetteSearch.
template <std::same_as<double> Real = double>
class SliceSearch {
public:
    Status locate(const ContactGeometry& geometry, const WheelsetPosition& at) {
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
        find_valleys(touch_);
        bool found = false;
        touch_ = touching_height(touch_, [&](double height) {
            const Foot* deepest = nullptr;
            for (Point& valley : valleys_) {
                descend(valley, height);
                if (deepest == nullptr || valley.foot.depth > deepest->depth) deepest = &valley.foot;
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
                if (foot_on_rail(*geometry_, rail->s, track_x_ + slice.x, sample.y, z).depth > most) {
                    return true;
                }
            }
        }
        return false;
    }

    std::vector<Region> regions(double height) {
        height_ = height;
        // points that lay too high above the rail to be valleys may touch now
        if (height - valleys_at_ > seen_above / 2) {
            find_valleys(height);
            for (Point& valley : valleys_) descend(valley, height);
            keep_different();
        }
        std::vector<Region> found;
        for (const Point& valley : valleys_) {
            Point seed = valley;
            descend(seed, height);
            if (!(seed.foot.depth > 0) || lies_in(found, seed)) continue;
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
    static constexpr double seen_above = 1e-3;      // largest height of valleys above the rail [m]

    struct Slice {
        double x;
        CurveIndex rail;
        std::vector<SurfaceSample> wheel;
    };
    // A point of the wheel and its foot on the rail.
    struct Point {
        double x, s, y, z;
        Foot foot;
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
            slice.rail.build(geometry_->rail_samples(track_x_ + slice.x));
            slice.wheel.clear();
            const auto count = static_cast<std::size_t>(std::ceil(wheel.length() / distance));
            for (std::size_t i = 0; i <= count; ++i) {
                const double s = wheel.length() * double(i) / double(count);
                const CurvePoint p = placed_->section(s, slice.x);
                const double size = std::hypot(p.slope[0], p.slope[1]);
                if (p.defined) slice.wheel.push_back({p.y, p.z, -p.slope[1] / size, p.slope[0] / size, s});
            }
        }
    }

    // Finds points of slices that lie at least as deep as their neighbours on the wheel and in both adjacent slices,
    // and less than a millimetre above the rail at this height.
    void find_valleys(double height) {
        constexpr double none = -std::numeric_limits<double>::infinity();
        valleys_at_ = height;
        std::vector<std::vector<Point>> points(slices_.size());
        for (std::size_t k = 0; k < slices_.size(); ++k) {
            const Slice& slice = slices_[k];
            for (const SurfaceSample& sample : slice.wheel) {
                const double z = sample.z + height;
                Point& p = points[k].emplace_back(Point{slice.x, sample.s, sample.y, z, {}, true});
                p.foot.depth = none;
                if (z - slice.rail.top(sample.y) < -seen_above - CurveIndex::reach) continue;
                const SurfaceSample* rail = slice.rail.facing(sample.y, z, sample.normal_y, sample.normal_z);
                if (rail == nullptr) continue;
                p.foot = foot_on_rail(*geometry_, rail->s, track_x_ + slice.x, sample.y, z);
                if (!p.foot.inside) p.foot.depth = none;
            }
        }
        valleys_.clear();
        for (std::size_t k = 0; k < points.size(); ++k) {
            for (std::size_t i = 0; i < points[k].size(); ++i) {
                const Point& p = points[k][i];
                if (!(p.foot.depth > -seen_above)) continue;
                // on a plateau, the first point
                const auto deeper = [&](const Point& other) {
                    const bool first = other.x < p.x || (other.x == p.x && other.s < p.s);
                    return other.foot.depth > p.foot.depth + (first ? -1e-12 : 1e-12) &&
                           std::hypot(other.y - p.y, other.z - p.z) < 1e-3;
                };
                bool is_valley =
                    !(i > 0 && deeper(points[k][i - 1])) && !(i + 1 < points[k].size() && deeper(points[k][i + 1]));
                for (const std::size_t beside : {k - 1, k + 1}) {
                    if (!is_valley || beside >= points.size()) continue;
                    is_valley = std::none_of(points[beside].begin(), points[beside].end(), deeper);
                }
                if (is_valley) valleys_.push_back(p);
            }
        }
        std::sort(valleys_.begin(), valleys_.end(),
                  [](const Point& one, const Point& two) { return one.foot.depth > two.foot.depth; });
    }

    // Keeps one of the valleys that have met.
    void keep_different() {
        std::vector<Point> kept;
        for (const Point& valley : valleys_) {
            const bool known = std::any_of(kept.begin(), kept.end(), [&](const Point& other) {
                return std::hypot(valley.x - other.x, valley.y - other.y, valley.z - other.z) < 2e-4;
            });
            if (!known && is_finite(valley.foot.depth)) kept.push_back(valley);
        }
        valleys_ = std::move(kept);
    }

    Point point_at(const Point& from, double x, double s, double height) const {
        Point p = from;
        p.x = x;
        p.s = s;
        const CurvePoint on_wheel = placed_->section(s, x);
        p.y = on_wheel.y;
        p.z = on_wheel.z + height;
        p.defined = on_wheel.defined && s >= 0 && s <= placed_->surface().length();
        if (!p.defined) return p;
        p.foot = foot_on_rail(*geometry_, from.foot.s, track_x_ + x, p.y, p.z);
        p.defined = p.foot.inside;
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
                    const double bend = one.foot.depth - 2 * p.foot.depth + two.foot.depth,
                                 to = bend < 0 ? std::clamp((one.foot.depth - two.foot.depth) / (2 * bend), -1.0, 1.0)
                                               : 0;
                    const Point vertex = beside(to * step);
                    if (vertex.defined && vertex.foot.depth > best.foot.depth) best = vertex;
                }
                for (const Point& other : {one, two}) {
                    if (other.defined && (!best.defined || other.foot.depth > best.foot.depth)) best = other;
                }
                p = best;
            }
            if (std::abs(p.s - start.s) < step_s && std::abs(p.x - start.x) < step_x) {
                step_s /= 3;
                step_x /= 3;
            }
        }
        if (!p.defined) p.foot.depth = -std::numeric_limits<double>::infinity();
    }

    static bool lies_in(const std::vector<Region>& found, const Point& p) {
        for (const Region& region : found) {
            for (const SurfaceCut& cut : region.cuts) {
                if (cut.foot.depth > 0 && std::hypot(cut.x - p.x, cut.y - p.y, cut.z - p.z) < 1.5e-3 &&
                    std::abs(cut.foot.angle() - p.foot.angle()) < joined_angle) {
                    return true;
                }
            }
        }
        return false;
    }

    // Adds the cuts at x about a point of the region, outwards along the wheel, until the wheel stays above the rail
    // for a while, or the part below the rail beyond a gap has another normal. Returns the ends of the part below the
    // rail on the wheel's curve, nothing if there is none. `step` [m] is the distance between cuts.
    std::optional<std::array<double, 2>> cut_slice(const Point& about, double step, double height,
                                                   std::vector<SurfaceCut>& cuts) const {
        const double length = placed_->surface().length();
        std::vector<SurfaceCut> slice;
        for (const int direction : {-1, 1}) {
            Point p = about;
            double last = p.s, stride = step, angle = p.foot.angle();
            bool gap = false;
            if (direction > 0) p = point_at(p, p.x, p.s + stride, height);
            while (std::abs(p.s - last) < joined_distance / 2 && p.s >= 0 && p.s <= length) {
                const bool below = p.defined && p.foot.depth > 0;
                if (below && gap && std::abs(p.foot.angle() - angle) >= joined_angle) break;
                gap = !below;
                slice.push_back({p.s, p.x, p.y, p.z, p.foot, 0});
                if (!below) slice.back().foot.depth = 0;
                if (below) {
                    last = p.s;
                    angle = p.foot.angle();
                }
                stride = below ? step : (std::max)(step, (std::min)(1.2 * stride, 1e-4));
                p = point_at(p, p.x, p.s + direction * stride, height);
            }
            if (direction < 0) std::reverse(slice.begin(), slice.end());
        }
        std::optional<std::array<double, 2>> range;
        for (std::size_t k = 0; k < slice.size(); ++k) {
            const SurfaceCut &before = slice[k > 0 ? k - 1 : 0], &after = slice[(std::min)(k + 1, slice.size() - 1)];
            if (!(slice[k].foot.depth > 0)) continue;
            slice[k].width = (std::max)(after.y - before.y, 0.0);
            if (!range) range = {slice[k].wheel_s, slice[k].wheel_s};
            (*range)[1] = slice[k].wheel_s;
            cuts.push_back(slice[k]);
        }
        return range;
    }

    // The regions about a point: one, or one for each of several contacts.
    std::vector<Region> explore(const Point& seed, double height) const {
        Region region;
        region.power = 2;
        // A tenth of the half-length, as estimated from the wheel's radius, and a fortieth of the width.
        const double step_x = std::clamp(std::sqrt(2 * seed.foot.depth * placed_->radius()) / 10, 2e-6, 1e-3);
        double step_s = 5e-5;
        for (int k = 0; k < 2; ++k) {
            region.cuts.clear();
            const auto range = cut_slice(seed, step_s, height, region.cuts);
            if (!range) return {};
            step_s = std::clamp(((*range)[1] - (*range)[0]) / 40, 1e-6, 2.5e-4);
        }
        for (const int direction : {-1, 1}) {
            Point about = seed;
            for (int k = 1; k < 400; ++k) {
                const double x = seed.x + direction * k * step_x;
                about = point_at(about, x, about.s, height);
                const auto range = cut_slice(about, step_s, height, region.cuts);
                if (!range) break;
                about = point_at(about, x, ((*range)[0] + (*range)[1]) / 2, height);
            }
        }
        for (SurfaceCut& cut : region.cuts) cut.width *= step_x;
        std::vector<Region> parts;
        part(std::move(region), step_x, parts);
        return parts;
    }

    // Parts a region; `step_x` [m] is the distance between cuts.
    static void part(Region region, double step_x, std::vector<Region>& parts) {
        const std::vector<SurfaceCut> ridge = ridge_of(region.cuts);
        const auto at = parting(ridge.begin(), ridge.end());
        if (at != ridge.end()) {
            Region beyond = region;
            std::erase_if(beyond.cuts, [&](const SurfaceCut& cut) { return cut.wheel_s < at->wheel_s; });
            std::erase_if(region.cuts, [&](const SurfaceCut& cut) { return cut.wheel_s >= at->wheel_s; });
            region.rail.high = beyond.rail.low = at->foot.s;
            part(std::move(region), step_x, parts);
            part(std::move(beyond), step_x, parts);
            return;
        }
        const auto [low, high] =
            std::minmax_element(region.cuts.begin(), region.cuts.end(),
                                [](const SurfaceCut& one, const SurfaceCut& other) { return one.x < other.x; });
        region.x_low = low->x - step_x;
        region.x_high = high->x + step_x;
        parts.push_back(std::move(region));
    }

    // The deepest cut of each tenth of a millimetre along the wheel's curve.
    static std::vector<SurfaceCut> ridge_of(std::vector<SurfaceCut> cuts) {
        constexpr double distance = 1e-4;
        const auto place = [](const SurfaceCut& cut) { return std::floor(cut.wheel_s / distance); };
        std::sort(cuts.begin(), cuts.end(), [&](const SurfaceCut& one, const SurfaceCut& other) {
            return std::pair(place(one), -one.foot.depth) < std::pair(place(other), -other.foot.depth);
        });
        cuts.erase(
            std::unique(cuts.begin(), cuts.end(),
                        [&](const SurfaceCut& one, const SurfaceCut& other) { return place(one) == place(other); }),
            cuts.end());
        return cuts;
    }

    static double angle_of(const Region& region) {
        return mean_angle(region.cuts.begin(), region.cuts.end(), region.power);
    }

    // Joins a region to one that is near and has nearly the same normal, or adds it. Returns its body.
    static std::size_t join(std::vector<Region>& found, Region region) {
        for (Region& other : found) {
            double least = std::numeric_limits<double>::infinity();
            for (const SurfaceCut& one : other.cuts) {
                for (const SurfaceCut& two : region.cuts) {
                    if (std::abs(one.wheel_s - two.wheel_s) > joined_distance) continue;
                    least = (std::min)(least, std::hypot(one.x - two.x, one.y - two.y, one.z - two.z));
                }
            }
            if (least >= joined_distance || std::abs(angle_of(other) - angle_of(region)) >= joined_angle) continue;
            other.cuts.insert(other.cuts.end(), region.cuts.begin(), region.cuts.end());
            other.x_low = (std::min)(other.x_low, region.x_low);
            other.x_high = (std::max)(other.x_high, region.x_high);
            for (Region& of : found) of.body = of.body == region.body ? other.body : of.body;
            return other.body;
        }
        found.push_back(std::move(region));
        return found.back().body;
    }

    const ContactGeometry* geometry_ = nullptr;
    std::optional<PlacedWheel> placed_;
    double track_x_ = 0, touch_ = 0, height_ = 0;
    double valleys_at_ = 0;  // height at which valleys were searched
    std::vector<Slice> slices_;
    std::vector<Point> valleys_;
};

}  // namespace rollbem::detail
