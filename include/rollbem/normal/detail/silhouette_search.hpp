// Contacts of a round wheel on a straight rail: on the wheel's silhouette, as all curves of the rail along x are
// straight lines.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "../../status.hpp"
#include "contact_region.hpp"

namespace rollbem::detail {

/// A search at one lateral position, roll and yaw: locate() first, then regions() at any height near the touching one.
template <std::same_as<double> Real = double>
class SilhouetteSearch {
public:
    /// Finds the height at which the wheel, lowered, touches first.
    Status locate(const ContactGeometry& geometry, const WheelsetPosition& at) {
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
            find_feet(height);
            const Sample* const sample = deepest();
            return sample == nullptr ? nullptr : &sample->foot;
        });
        return Status::ok;
    }

    double touch() const { return touch_; }  ///< the height at which the wheel begins to touch [m]

    /// The point of first touch: a point of the wheel at that height, and of the rail; nothing where a curve ends
    /// there. Follows locate().
    std::optional<SurfaceCut> first_point() const {
        const Sample* const sample = deepest();
        if (sample == nullptr || sample == &samples_.front() || sample == &samples_.back()) return std::nullopt;
        double low = (sample - 1)->s, high = (sample + 1)->s;
        SurfaceCut cut{};
        for (int k = 0; k < 45; ++k) {
            cut.wheel_s = (low + high) / 2;
            const double steeper = place(cut, sample->foot.s);
            if (!is_finite(steeper)) return std::nullopt;
            (steeper > 0 ? high : low) = cut.wheel_s;
        }
        if (!cut.foot.inside) return std::nullopt;
        return cut;
    }

    /// Whether the wheel at the height of the last regions lies more than a millimetre within the rail somewhere.
    bool is_too_deep() const {
        constexpr double most = 1e-3;
        return std::any_of(samples_.begin(), samples_.end(), [this](const Sample& sample) {
            const double below = sample.z + height_ - geometry_->index().top(sample.y);
            return below > most && (!sample.close || sample.foot.depth > most);
        });
    }

    /// The regions at a height, in the order of the wheel's curve.
    std::vector<Region> regions(double height) {
        find_feet(height);
        std::vector<Run> runs;
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            const Sample& sample = samples_[i];
            if (!sample.close || !sample.foot.inside || !(sample.foot.depth > 0)) continue;
            const bool goes_on = !runs.empty() && runs.back().last + 1 == i &&
                                 std::abs(sample.foot.s - samples_[i - 1].foot.s) < joined_distance;
            if (goes_on) {
                runs.back().last = i;
            } else {
                runs.push_back({.first = i, .last = i, .body = runs.size()});
            }
        }
        part(runs);
        join(runs);
        std::vector<Region> found;
        for (const Run& run : runs) found.push_back(region(run, height));
        std::erase_if(found, [](const Region& region) {
            return std::none_of(region.cuts.begin(), region.cuts.end(),
                                [](const SurfaceCut& cut) { return cut.foot.depth > 0; });
        });
        return found;
    }

private:
    // A point of the wheel's silhouette at height 0 and, if near, its foot at the last height asked for.
    struct Sample {
        double s, y, z, normal_y, normal_z;
        bool at_border, close;
        Foot foot;
    };
    struct Run {
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
            const PlacedWheel::Place p = placed_->silhouette(s);
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
            if (sample.close && (found == nullptr || sample.foot.depth > found->foot.depth)) found = &sample;
        }
        return found;
    }

    // Sets both points of a cut at the touching height; returns a number with the sign of the rail's slope minus the
    // wheel's, NaN where the silhouette is not defined.
    double place(SurfaceCut& cut, double rail_s) const {
        constexpr double beside = 1e-7;  // [m]
        const PlacedWheel::Place one = placed_->silhouette(cut.wheel_s - beside),
                                 two = placed_->silhouette(cut.wheel_s + beside);
        if (!one.defined || !two.defined) return std::numeric_limits<double>::quiet_NaN();
        const double dy = two.y - one.y, dz = two.z - one.z;
        cut.x = (one.x + two.x) / 2;
        cut.y = (one.y + two.y) / 2;
        cut.z = (one.z + two.z) / 2 + touch_;
        cut.foot = foot_on_rail(*geometry_, rail_s, 0, cut.y, cut.z);
        return dy * cut.foot.slope[1] - dz * cut.foot.slope[0];
    }

    void find_feet(double height) {
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
                if (sample.close) sample.foot.s = rail->s;
            }
            if (sample.close) sample.foot = foot_on_rail(*geometry_, sample.foot.s, 0, sample.y, z);
            if (anew) sample.close = sample.close && sample.foot.depth > -out_of_reach;
        }
    }

    double mean_angle_of(const Run& run) const {
        return mean_angle(samples_.begin() + std::ptrdiff_t(run.first), samples_.begin() + std::ptrdiff_t(run.last) + 1,
                          Region{}.power);
    }

    void part(std::vector<Run>& runs) const {
        for (std::size_t k = 0; k < runs.size();) {
            const auto last = samples_.begin() + std::ptrdiff_t(runs[k].last) + 1,
                       at = parting(samples_.begin() + std::ptrdiff_t(runs[k].first), last);
            if (at == last) {
                ++k;
                continue;
            }
            Run beyond = runs[k];
            beyond.first = std::size_t(at - samples_.begin());
            beyond.rail.low = at->foot.s;
            runs[k].last = beyond.first - 1;
            runs[k].rail.high = beyond.rail.low;
            runs.insert(runs.begin() + std::ptrdiff_t(k) + 1, beyond);
        }
    }

    void join(std::vector<Run>& runs) const {
        for (std::size_t k = 1; k < runs.size();) {
            const Sample &here = samples_[runs[k - 1].last], &next = samples_[runs[k].first];
            const bool close =
                next.s - here.s < joined_distance && std::abs(next.foot.s - here.foot.s) < joined_distance;
            if (close && std::abs(mean_angle_of(runs[k]) - mean_angle_of(runs[k - 1])) < joined_angle) {
                runs[k - 1].last = runs[k].last;
                runs[k - 1].rail.high = runs[k].rail.high;
                const std::size_t body = runs[k].body;
                runs.erase(runs.begin() + std::ptrdiff_t(k));
                for (Run& run : runs) run.body = run.body == body ? runs[k - 1].body : run.body;
            } else {
                ++k;
            }
        }
    }

    // Extent along x of the wheel's part below the rail about a point of the silhouette.
    double reach_along(const Foot& foot) const {
        constexpr double steepest = 0.05;
        return std::sqrt(2 * foot.depth * placed_->radius() / (std::max)(std::cos(foot.angle()), steepest));
    }

    Region region(const Run& run, double height) const {
        const Sample &one = samples_[run.first > 0 ? run.first - 1 : 0],
                     &two = samples_[(std::min)(run.last + 1, samples_.size() - 1)];
        constexpr int count = 160;
        Region region;
        region.rail = run.rail;
        region.body = run.body;
        region.x_low = std::numeric_limits<double>::infinity();
        region.x_high = -region.x_low;
        double rail_s = samples_[run.first].foot.s;
        for (int k = 0; k <= count; ++k) {
            const double s = one.s + (two.s - one.s) * k / count;
            const PlacedWheel::Place p = placed_->silhouette(s);
            if (!p.defined) continue;
            const Foot foot = foot_on_rail(*geometry_, rail_s, 0, p.y, p.z + height);
            rail_s = foot.s;
            region.cuts.push_back({s, p.x, p.y, p.z + height, foot, 0});
            if (!foot.inside) region.cuts.back().foot.depth = 0;
            if (!(region.cuts.back().foot.depth > 0)) continue;
            const double reach = reach_along(foot);
            region.x_low = (std::min)(region.x_low, p.x - reach);
            region.x_high = (std::max)(region.x_high, p.x + reach);
        }
        for (std::size_t k = 0; k < region.cuts.size(); ++k) {
            const SurfaceCut &before = region.cuts[k > 0 ? k - 1 : 0],
                             &after = region.cuts[(std::min)(k + 1, region.cuts.size() - 1)];
            region.cuts[k].width = (std::max)(after.y - before.y, 0.0);
        }
        return region;
    }

    const ContactGeometry* geometry_ = nullptr;
    std::optional<PlacedWheel> placed_;
    std::vector<Sample> samples_;
    bool is_whole_ = true;  // the silhouette is defined everywhere
    double touch_ = 0, height_ = 0, searched_at_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace rollbem::detail
