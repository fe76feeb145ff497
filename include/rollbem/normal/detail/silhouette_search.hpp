// Contacts of a round wheel on a straight rail: on the wheel's silhouette, as all curves of the rail along x are
// straight lines.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "../../detail/finite.hpp"
#include "../../status.hpp"
#include "contact_region.hpp"
#include "curve_index.hpp"

namespace rollbem::detail {

/// A search at one lateral position, roll and yaw: locate() first, then regions() at any height near the touching one.
class SilhouetteSearch {
public:
    /// Finds the height at which the wheel, lowered, touches first.
    Status locate(const WheelOnRail::Geometry& geometry, const WheelsetPosition& at) {
        geometry_ = &geometry;
        placed_.emplace(geometry.placed(at));
        trace();
        const Sample* lowest = nullptr;
        touch_ = std::numeric_limits<double>::infinity();
        for (const Sample& sample : samples_) {
            const double gap = geometry.index().top(sample.y) - sample.z;
            if (gap < touch_) lowest = &sample;
            touch_ = (std::min)(touch_, gap);
        }
        if (lowest == nullptr) return is_whole_ ? Status::no_contact : Status::undefined_section;
        if (lowest->at_border) return Status::undefined_section;
        // the highest points of the rail are known with the resolution of its samples
        touch_ = touching_height(touch_, [this](double height) {
            find_closest_points(height);
            const Sample* const sample = deepest();
            return sample == nullptr ? nullptr : &sample->closest;
        });
        return Status::ok;
    }

    double touch() const { return touch_; }  ///< the height at which the wheel begins to touch [m]

    /// The point of first touch: a point of the wheel at that height, and of the rail; nothing where a curve ends
    /// there. Follows locate().
    std::optional<PenetrationSample> first_point() const {
        const Sample* const sample = deepest();
        if (sample == nullptr || sample == &samples_.front() || sample == &samples_.back()) return std::nullopt;
        double low = (sample - 1)->s, high = (sample + 1)->s;
        PenetrationSample point{};
        for (int k = 0; k < 45; ++k) {
            point.wheel_s = (low + high) / 2;
            const double steeper = place(point, sample->closest.s);
            if (!is_finite(steeper)) return std::nullopt;
            (steeper > 0 ? high : low) = point.wheel_s;
        }
        if (!point.closest.inside) return std::nullopt;
        return point;
    }

    /// Whether the wheel at the height of the last regions lies more than a millimetre within the rail somewhere.
    bool is_too_deep() const {
        constexpr double most = 1e-3;
        return std::any_of(samples_.begin(), samples_.end(), [this](const Sample& sample) {
            const double below = sample.z + height_ - geometry_->index().top(sample.y);
            return below > most && (!sample.close || sample.closest.depth > most);
        });
    }

    /// The regions at a height, in the order of the wheel's curve.
    std::vector<Region> regions(double height) {
        find_closest_points(height);
        std::vector<SampleRange> ranges;
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            const Sample& sample = samples_[i];
            if (!sample.close || !sample.closest.inside || !(sample.closest.depth > 0)) continue;
            const bool goes_on = !ranges.empty() && ranges.back().last + 1 == i &&
                                 std::abs(sample.closest.s - samples_[i - 1].closest.s) < joined_distance;
            if (goes_on) {
                ranges.back().last = i;
            } else {
                ranges.push_back({.first = i, .last = i, .body = ranges.size()});
            }
        }
        split(ranges);
        join(ranges);
        std::vector<Region> found;
        for (const SampleRange& range : ranges) found.push_back(region(range, height));
        std::erase_if(found, [](const Region& region) {
            return std::none_of(region.samples.begin(), region.samples.end(),
                                [](const PenetrationSample& of) { return of.closest.depth > 0; });
        });
        return found;
    }

private:
    // A point of the wheel's silhouette at height 0 and, if near, the rail's closest point at the last height searched.
    struct Sample {
        double s, y, z, normal_y, normal_z;
        bool at_border, close;
        ClosestPoint closest;
    };
    // Numbers of the first and the last sample of a region.
    struct SampleRange {
        std::size_t first, last, body;
        RailStretch rail{};
    };

    void trace() {
        constexpr double distance = 1e-4;  // flange contacts are four times as wide at least
        const double length = placed_->surface().length();
        const auto count = static_cast<std::size_t>(std::ceil(length / distance));
        samples_.clear();
        searched_at_ = std::numeric_limits<double>::quiet_NaN();
        is_whole_ = true;
        bool before = true;
        for (std::size_t k = 0; k <= count; ++k) {
            const double s = length * double(k) / double(count);
            const WheelSurface::Placed::Place p = placed_->silhouette(s);
            if (p.defined) {
                samples_.push_back({s, p.y, p.z, 0, 0, !before, false, {}});
            } else if (before && !samples_.empty()) {
                samples_.back().at_border = true;
            }
            before = p.defined;
            is_whole_ = is_whole_ && p.defined;
        }
        for (std::size_t k = 0; k < samples_.size(); ++k) {
            const Sample &one = samples_[k > 0 ? k - 1 : 0], &two = samples_[(std::min)(k + 1, samples_.size() - 1)];
            const double size = (std::max)(std::hypot(two.y - one.y, two.z - one.z), 1e-300);
            samples_[k].normal_y = -(two.z - one.z) / size;
            samples_[k].normal_z = (two.y - one.y) / size;
        }
    }

    const Sample* deepest() const {
        const Sample* found = nullptr;
        for (const Sample& sample : samples_) {
            if (sample.close && (found == nullptr || sample.closest.depth > found->closest.depth)) found = &sample;
        }
        return found;
    }

    // Sets both points of a sample at the touching height; returns a number with the sign of the rail's slope minus the
    // wheel's, NaN where the silhouette is not defined.
    double place(PenetrationSample& of, double rail_s) const {
        constexpr double beside = 1e-7;  // [m]
        const WheelSurface::Placed::Place one = placed_->silhouette(of.wheel_s - beside),
                                          two = placed_->silhouette(of.wheel_s + beside);
        if (!one.defined || !two.defined) return std::numeric_limits<double>::quiet_NaN();
        const double dy = two.y - one.y, dz = two.z - one.z;
        of.x = (one.x + two.x) / 2;
        of.y = (one.y + two.y) / 2;
        of.z = (one.z + two.z) / 2 + touch_;
        of.closest = closest_on_rail(*geometry_, rail_s, 0, of.y, of.z);
        return dy * of.closest.slope[1] - dz * of.closest.slope[0];
    }

    void find_closest_points(double height) {
        height_ = height;
        // Samples that were far above the rail remain so while the height changes by less than this.
        constexpr double out_of_reach = 4e-4;
        const bool anew = !(std::abs(height - searched_at_) < out_of_reach);
        if (anew) searched_at_ = height;
        for (Sample& sample : samples_) {
            const double z = sample.z + height;
            if (anew) {
                const SurfaceSample* rail = geometry_->index().facing(sample.y, z, sample.normal_y, sample.normal_z);
                sample.close = rail != nullptr;
                if (sample.close) sample.closest.s = rail->s;
            }
            if (sample.close) sample.closest = closest_on_rail(*geometry_, sample.closest.s, 0, sample.y, z);
            if (anew) sample.close = sample.close && sample.closest.depth > -out_of_reach;
        }
    }

    double mean_angle_of(const SampleRange& range) const {
        return mean_angle(samples_.begin() + std::ptrdiff_t(range.first),
                          samples_.begin() + std::ptrdiff_t(range.last) + 1, Region{}.power);
    }

    void split(std::vector<SampleRange>& ranges) const {
        for (std::size_t k = 0; k < ranges.size();) {
            const auto last = samples_.begin() + std::ptrdiff_t(ranges[k].last) + 1,
                       at = find_split(samples_.begin() + std::ptrdiff_t(ranges[k].first), last);
            if (at == last) {
                ++k;
                continue;
            }
            SampleRange beyond = ranges[k];
            beyond.first = std::size_t(at - samples_.begin());
            beyond.rail.low = at->closest.s;
            ranges[k].last = beyond.first - 1;
            ranges[k].rail.high = beyond.rail.low;
            ranges.insert(ranges.begin() + std::ptrdiff_t(k) + 1, beyond);
        }
    }

    void join(std::vector<SampleRange>& ranges) const {
        for (std::size_t k = 1; k < ranges.size();) {
            const Sample &here = samples_[ranges[k - 1].last], &next = samples_[ranges[k].first];
            const bool close =
                next.s - here.s < joined_distance && std::abs(next.closest.s - here.closest.s) < joined_distance;
            if (close && std::abs(mean_angle_of(ranges[k]) - mean_angle_of(ranges[k - 1])) < joined_angle) {
                ranges[k - 1].last = ranges[k].last;
                ranges[k - 1].rail.high = ranges[k].rail.high;
                const std::size_t body = ranges[k].body;
                ranges.erase(ranges.begin() + std::ptrdiff_t(k));
                for (SampleRange& of : ranges) of.body = of.body == body ? ranges[k - 1].body : of.body;
            } else {
                ++k;
            }
        }
    }

    // Extent along x of the overlap about a point of the silhouette.
    double reach_along(const ClosestPoint& closest) const {
        constexpr double steepest = 0.05;
        return std::sqrt(2 * closest.depth * placed_->radius() / (std::max)(std::cos(closest.angle()), steepest));
    }

    Region region(const SampleRange& range, double height) const {
        const Sample &one = samples_[range.first > 0 ? range.first - 1 : 0],
                     &two = samples_[(std::min)(range.last + 1, samples_.size() - 1)];
        constexpr int count = 160;
        Region region;
        region.rail = range.rail;
        region.body = range.body;
        region.x_low = std::numeric_limits<double>::infinity();
        region.x_high = -region.x_low;
        double rail_s = samples_[range.first].closest.s;
        for (int k = 0; k <= count; ++k) {
            const double s = one.s + (two.s - one.s) * k / count;
            const WheelSurface::Placed::Place p = placed_->silhouette(s);
            if (!p.defined) continue;
            const ClosestPoint closest = closest_on_rail(*geometry_, rail_s, 0, p.y, p.z + height);
            rail_s = closest.s;
            region.samples.push_back({s, p.x, p.y, p.z + height, closest, 0});
            if (!closest.inside) region.samples.back().closest.depth = 0;
            if (!(region.samples.back().closest.depth > 0)) continue;
            const double reach = reach_along(closest);
            region.x_low = (std::min)(region.x_low, p.x - reach);
            region.x_high = (std::max)(region.x_high, p.x + reach);
        }
        for (std::size_t k = 0; k < region.samples.size(); ++k) {
            const PenetrationSample &before = region.samples[k > 0 ? k - 1 : 0],
                                    &after = region.samples[(std::min)(k + 1, region.samples.size() - 1)];
            region.samples[k].width = (std::max)(after.y - before.y, 0.0);
        }
        return region;
    }

    const WheelOnRail::Geometry* geometry_ = nullptr;
    std::optional<WheelSurface::Placed> placed_;
    std::vector<Sample> samples_;
    bool is_whole_ = true;  // the silhouette is defined everywhere
    double touch_ = 0, height_ = 0, searched_at_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace rollbem::detail
