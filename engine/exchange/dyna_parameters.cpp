#include "engine/exchange/dyna_parameters.h"

#include <cctype>

#include "engine/exchange/deck_number.h"

namespace spia {
namespace {

std::string small_letters(std::string_view text)
{
    std::string result(text);
    for (char& c : result)
        c = char(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

/// Of a number; it may have a sign already.
std::string negative(const std::string& value)
{
    return value.starts_with('-') ? value.substr(1) : "-" + (value.starts_with('+') ? value.substr(1) : value);
}

} // namespace

/// @param name  after its type: "R thood" or "Rthood"
void DynaParameters::set(std::string_view name, std::string_view value, bool local)
{
    if (name.size() > 1)
        (local ? values_.back() : values_.front())[small_letters(trimmed(name.substr(1)))] =
            std::string(trimmed(value));
}

void DynaParameters::define(const DeckFields& card, bool local)
{
    for (size_t i = 0; i + 1 < card.count(); i += 2)
        set(trimmed(card[i]), card[i + 1], local);
}

void DynaParameters::define_expression(std::string_view line, int width, bool local)
{
    const size_t comma = line.find(',');
    const size_t cut = comma != line.npos ? comma : std::min(line.size(), size_t(width));
    const std::string_view value = trimmed(line.substr(std::min(line.size(), comma != line.npos ? cut + 1 : cut)));
    if (deck_number(value))
        set(trimmed(line.substr(0, cut)), value, local);
}

std::optional<std::string> DynaParameters::find(std::string_view field)
{
    const bool minus = field.starts_with('-');
    const std::string name = small_letters(trimmed(field.substr(minus ? 2 : 1)));
    for (auto file = values_.rbegin(); file != values_.rend(); ++file)
        if (const auto found = file->find(name); found != file->end())
            return minus ? negative(found->second) : found->second;
    undefined_.insert(std::string(field.substr(minus ? 1 : 0)));
    return std::nullopt;
}

std::string DynaParameters::undefined() const
{
    std::string text;
    for (const std::string& name : undefined_)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

} // namespace spia
