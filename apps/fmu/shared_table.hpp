// Tables from files; each file is read once for all instances that use it.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

#include "model.hpp"

namespace fmu {

/// The table in the file `path`, which `parameter` names. Throws std::invalid_argument if there is none.
template <class Table>
std::shared_ptr<const Table> shared_table(const std::string& parameter, const std::string& path) {
    static std::mutex mutex;
    static std::map<std::string, std::weak_ptr<const Table>> tables;
    const std::scoped_lock lock(mutex);
    std::weak_ptr<const Table>& known = tables[path];
    if (auto table = known.lock()) return table;
    const std::u8string text(path.begin(), path.end());  // in UTF-8 on all platforms
    try {
        auto table = std::make_shared<const Table>(Table::read(std::filesystem::path(text)));
        known = table;
        return table;
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(std::string(identity.identifier) + ": " + parameter + " = " + path + ": " +
                                    error.what());
    }
}

}  // namespace fmu
