#include "engine/core/json_file.h"

#include <algorithm>
#include <fmt/core.h>
#include <fstream>
#include <set>
#include <sstream>
#include <system_error>
#include <vector>

#include "engine/core/error.h"

namespace spia {
namespace {

/// Without the library's "[json.exception.parse_error.101] ".
std::string plain(const Json::exception& error)
{
    const std::string text = error.what();
    const size_t end = text.find("] ");
    return end == std::string::npos ? text : text.substr(end + 2);
}

/// Sees that no object has a member twice: the library would take the last one without a word.
class MembersOnce {
public:
    explicit MembersOnce(const std::string& file) : file_(file) {}

    void see(Json::parse_event_t event, const Json& value)
    {
        using Event = Json::parse_event_t;
        if (event == Event::array_end || event == Event::object_end) {
            open_.pop_back();
            return;
        }
        if (event == Event::key) {
            open_.back().at = value.get<std::string>();
            if (!open_.back().keys.insert(open_.back().at).second)
                throw InputError(fmt::format("{}: {} is there twice; leave one of them", file_, place()));
            return;
        }
        if (!open_.empty() && open_.back().is_array)
            open_.back().at = std::to_string(open_.back().entries++);
        if (event == Event::array_start || event == Event::object_start)
            open_.push_back({event == Event::array_start, 0, {}, {}});
    }

private:
    struct Open {
        bool is_array;
        size_t entries;
        std::string at; ///< the member or entry that is being read
        std::set<std::string> keys;
    };

    std::string place() const
    {
        std::string text;
        for (const Open& open : open_)
            text += "/" + open.at;
        return text;
    }

    const std::string& file_;
    std::vector<Open> open_;
};

} // namespace

Json parse_json(std::string_view text, const std::string& name, bool comments)
{
    try {
        MembersOnce once(name);
        const auto see = [&](int, Json::parse_event_t event, Json& value) {
            once.see(event, value);
            return true;
        };
        return Json::parse(text, see, true, comments);
    } catch (const Json::parse_error& error) {
        if (error.byte > text.size()) // counted from 1
            throw InputError(fmt::format("{} ends in the middle, at line {}: it was cut off; copy or save it again",
                                         name, 1 + std::ranges::count(text, '\n')));
        throw InputError(fmt::format("{}: {}", name, plain(error)));
    } catch (const Json::exception& error) {
        throw InputError(fmt::format("{}: {}", name, plain(error)));
    }
}

Json read_json(const std::filesystem::path& file, bool comments)
{
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) // a folder, or a device that never ends
        throw InputError(fmt::format("{} is not there or is no file; choose another one", file.string()));
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream || !text)
        throw InputError(fmt::format("cannot read {}; it is empty, or you may not read it", file.string()));
    return parse_json(text.view(), file.string(), comments);
}

std::string lines_of(const Json& object, const std::string& what)
{
    try {
        std::string text = "{";
        for (const auto& [key, value] : object.items())
            text += fmt::format("{}\n{}: {}", text.size() == 1 ? "" : ",", Json(key).dump(), value.dump());
        return text + "\n}\n";
    } catch (const Json::exception& error) {
        throw ExchangeError(
            fmt::format("cannot write {}: a name or path in it is not UTF-8 ({}); rename it", what, plain(error)));
    }
}

std::string Place::text() const
{
    if (!parent_)
        return std::string(name_);
    std::string before = parent_->text();
    if (!parent_->parent_)
        before += before.empty() ? "/" : ": /";
    else
        before += '/';
    return before + (entry_ >= 0 ? std::to_string(entry_) : std::string(name_));
}

void Place::fail(std::string_view what) const { throw InputError(fmt::format("{} {}", text(), what)); }

} // namespace spia
