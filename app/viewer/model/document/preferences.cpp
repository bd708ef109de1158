#include "app/viewer/model/document/preferences.h"

#include <fmt/core.h>

#include "app/viewer/model/actions/members.h"
#include "app/viewer/model/document/recent_files.h"
#include "engine/core/atomic_file.h"
#include "engine/core/error.h"

namespace fs = std::filesystem;

namespace spia::viewer {
namespace {

constexpr const char* preferences_schema = "spia-preferences/1";

fs::path preferences_file() { return config_folder() / "preferences.json"; }

/// One member, if its value can be taken. @returns whether it is this one
template <class M>
bool take_member(const M& m, const std::string& key, const Json& value, const Place& place, KeptPreferences& kept)
{
    if (m.name != key)
        return false;
    Preferences changed = kept.preferences;
    try {
        read(value, changed.*m.where, place.member(key));
        m.check(changed.*m.where, place.member(key));
        kept.preferences = changed;
    } catch (const Error& error) {
        kept.left_out.push_back(fmt::format("A preference was left out: {}.", error.what()));
    }
    return true;
}

} // namespace

KeptPreferences read_preferences()
{
    KeptPreferences kept;
    try {
        const fs::path file = preferences_file();
        std::error_code ignored;
        if (!fs::exists(file, ignored))
            return kept;
        const std::string name = file.filename().string(); // where it lies is no news
        const Json json = read_json(file);
        if (!json.is_object() || json.value("schema", Json()) != preferences_schema)
            throw InputError(fmt::format("{} does not begin with {{\"schema\": \"{}\"", name, preferences_schema));
        for (const auto& [key, value] : json.items()) {
            if (key == "schema")
                continue;
            const bool known =
                std::apply([&](const auto&... m) { return (take_member(m, key, value, Place(name), kept) || ...); },
                           members_of<Preferences>);
            if (!known)
                kept.left_out.push_back(
                    fmt::format("A preference was left out: {} has the unknown member \"{}\".", name, key));
        }
    } catch (const std::exception& error) {
        kept.left_out.push_back(
            fmt::format("The preferences cannot be read, the defaults are used: {}.", error.what()));
    }
    return kept;
}

void keep_preferences(const Preferences& preferences)
{
    std::error_code error;
    fs::create_directories(config_folder(), error);
    if (error)
        throw ExchangeError(fmt::format("cannot make the folder {}: {}; check who may write there",
                                        config_folder().string(), error.message()));
    Json json = written(preferences);
    json["schema"] = preferences_schema;
    const fs::path file = preferences_file();
    write_atomically(file, lines_of(json, file.string()));
}

} // namespace spia::viewer
