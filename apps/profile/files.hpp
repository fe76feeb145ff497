// The folder of --outline: outlines and pressures of patches, as patch_study reads them.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>

#include <rollbem/normal/wheel_on_rail.hpp>

#include "support/csv.hpp"
#include "support/options.hpp"

namespace profile {

/// Files P_SIDE_K.outline.csv and P_SIDE_K.pressure.csv of position P, wheel SIDE and patch K, counted from 1, in
/// metres. Several threads may add to them.
class PatchFiles {
public:
    explicit PatchFiles(const study::Options& options) : folder_(options.text("outline")) {
        study::make_folder(folder_, "--outline");
    }

    void add(std::size_t position, bool left, std::size_t number, const rollbem::RailPatch& patch) {
        // a left wheel is a mirror image: s is reversed
        const double sign = left ? -1 : 1;
        const rollbem::Outline<double>& outline = *patch.outline;
        std::string edges = "y,x_trailing,x_leading\n", pressures = "x,y,pressure\n";
        for (Eigen::Index i = 0; i < outline.y().size(); ++i) {
            const double y = outline.y()[left ? outline.y().size() - 1 - i : i];
            edges += study::csv_line({sign * y, outline.trailing(y), outline.leading(y)});
        }
        const rollbem::CellGrid& grid = patch.grid;
        for (Eigen::Index i = 0; i < grid.nx; ++i) {
            for (Eigen::Index j = 0; j < grid.ny; ++j) {
                pressures += study::csv_line({grid.x(i), sign * grid.y(j), patch.pressure(i, j)});
            }
        }
        const std::string name =
            std::to_string(position + 1) + (left ? "_left_" : "_right_") + std::to_string(number + 1);
        const std::lock_guard<std::mutex> lock(mutex_);
        texts_[name + ".outline.csv"] = std::move(edges);
        texts_[name + ".pressure.csv"] = std::move(pressures);
    }

    void write() {
        for (const auto& [name, text] : texts_) {
            study::OutputFile file(folder_ + "/" + name, "--outline");
            file.write(text);
            file.commit();
        }
    }

private:
    std::string folder_;
    std::mutex mutex_;
    std::map<std::string, std::string> texts_;
};

}  // namespace profile
