#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace spia {

/// Members keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// @param name of the text, for messages
/// @param comments  /* */ and // are allowed
/// @throws InputError with line and column
Json parse_json(std::string_view text, const std::string& name, bool comments = false);

/// @throws InputError if there is no such file or it is no JSON
Json read_json(const std::filesystem::path& file, bool comments = false);

/// One line per member of the object: short, and a person finds their way in it.
/// @param what  for messages: what is to be written
/// @throws ExchangeError if a text in it is no UTF-8
std::string lines_of(const Json& object, const std::string& what);

/// Where a value stands in a file; only made into words if something is wrong there. Its parents
/// must outlive it.
class Place {
public:
    explicit Place(std::string_view file) : name_(file) {}
    Place member(std::string_view name) const { return Place(this, name, -1); }
    Place entry(size_t i) const { return Place(this, {}, long(i)); }

    std::string text() const;                            ///< e.g. "door.spia: /regions/3/name"
    [[noreturn]] void fail(std::string_view what) const; ///< @throws InputError "door.spia:
                                                         ///< /regions/3/name what"

private:
    Place(const Place* parent, std::string_view name, long entry) : parent_(parent), name_(name), entry_(entry) {}

    const Place* parent_ = nullptr;
    std::string_view name_;
    long entry_ = -1;
};

} // namespace spia
