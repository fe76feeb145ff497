// The points of a rail's curves at one x, sorted into square cells, so that the time to find the point that faces a
// point of the wheel does not depend on their number.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace rollbem::detail {

/// A point of a curve of a surface in track axes [m], its unit normal (into the rail, out of the wheel), and its place
/// on the curve.
struct SurfaceSample {
    double y, z, normal_y, normal_z;
    double s;
};

class CurveIndex {
public:
    /// Largest distance of a sample from the point for which it is searched [m].
    static constexpr double reach = 2e-3;
    /// Largest distance of neighbouring samples along a curve without interruptions [m].
    static constexpr double spacing = 2.5e-4;

    void build(std::vector<SurfaceSample> samples) {
        samples_ = std::move(samples);
        tops_.assign(2, std::numeric_limits<double>::infinity());
        columns_ = rows_ = 0;
        if (samples_.empty()) return;
        low_y_ = low_z_ = std::numeric_limits<double>::infinity();
        double high_y = -low_y_, high_z = -low_y_;
        for (const SurfaceSample& sample : samples_) {
            low_y_ = (std::min)(low_y_, sample.y);
            low_z_ = (std::min)(low_z_, sample.z);
            high_y = (std::max)(high_y, sample.y);
            high_z = (std::max)(high_z, sample.z);
        }
        columns_ = std::ptrdiff_t((high_y - low_y_) / reach) + 1;
        rows_ = std::ptrdiff_t((high_z - low_z_) / reach) + 1;
        first_.assign(std::size_t(columns_ * rows_) + 1, 0);
        for (const SurfaceSample& sample : samples_) ++first_[cell(sample.y, sample.z) + 1];
        for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
        sorted_.resize(samples_.size());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::size_t k = 0; k < samples_.size(); ++k) sorted_[next[cell(samples_[k].y, samples_[k].z)]++] = k;
        find_tops(high_y);
    }

    /// The nearest sample within reach whose normal is within 60 degrees of the given one; nullptr if there is none.
    const SurfaceSample* facing(double y, double z, double normal_y, double normal_z) const {
        const SurfaceSample* found = nullptr;
        double least = reach * reach;
        const auto column = std::ptrdiff_t(std::floor((y - low_y_) / reach)),
                   row = std::ptrdiff_t(std::floor((z - low_z_) / reach));
        for (auto i = (std::max)(column - 1, std::ptrdiff_t(0)); i <= (std::min)(column + 1, columns_ - 1); ++i) {
            for (auto j = (std::max)(row - 1, std::ptrdiff_t(0)); j <= (std::min)(row + 1, rows_ - 1); ++j) {
                const auto at = std::size_t(i * rows_ + j);
                for (std::size_t k = first_[at]; k < first_[at + 1]; ++k) {
                    const SurfaceSample& sample = samples_[sorted_[k]];
                    const double square = (sample.y - y) * (sample.y - y) + (sample.z - z) * (sample.z - z);
                    if (square >= least || sample.normal_y * normal_y + sample.normal_z * normal_z < 0.5) continue;
                    least = square;
                    found = &sample;
                }
            }
        }
        return found;
    }

    /// z of the highest point above y, with the resolution of the samples; infinite beside the rail.
    double top(double y) const {
        const double at = (y - low_y_) / column_;
        if (!(at >= 0 && at <= double(tops_.size()) - 1)) return std::numeric_limits<double>::infinity();
        const auto k = (std::min)(static_cast<std::size_t>(at), tops_.size() - 2);
        const double part = at - double(k);
        if (part == 0) return tops_[k];
        return (1 - part) * tops_[k] + part * tops_[k + 1];
    }

    bool empty() const { return samples_.empty(); }

private:
    std::size_t cell(double y, double z) const {
        return std::size_t(std::ptrdiff_t((y - low_y_) / reach) * rows_ + std::ptrdiff_t((z - low_z_) / reach));
    }

    // Finds the highest points on lines of constant y, by the chords between neighbouring samples.
    void find_tops(double high_y) {
        tops_.assign(std::size_t((high_y - low_y_) / column_) + 2, std::numeric_limits<double>::infinity());
        for (std::size_t k = 1; k < samples_.size(); ++k) {
            const SurfaceSample &one = samples_[k - 1], &two = samples_[k];
            if (two.s - one.s > 1.5 * spacing) continue;  // interrupted
            const double from = (std::min)(one.y, two.y), to = (std::max)(one.y, two.y);
            for (auto i = std::size_t(std::ceil((from - low_y_) / column_)); low_y_ + double(i) * column_ <= to; ++i) {
                const double share = (low_y_ + double(i) * column_ - one.y) / (two.y - one.y);
                tops_[i] = (std::min)(tops_[i], one.z + (two.y == one.y ? 0 : share * (two.z - one.z)));
            }
        }
    }

    static constexpr double column_ = 2.5e-4;
    std::vector<SurfaceSample> samples_;
    double low_y_ = 0, low_z_ = 0;
    std::ptrdiff_t columns_ = 0, rows_ = 0;
    std::vector<std::size_t> first_, sorted_;
    std::vector<double> tops_;
};

}  // namespace rollbem::detail
