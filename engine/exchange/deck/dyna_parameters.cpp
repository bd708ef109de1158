#include "engine/exchange/deck/dyna_parameters.h"

#include <cctype>
#include <cmath>
#include <fmt/core.h>

#include "engine/core/read_number.h"
#include "engine/core/text.h"
#include "engine/exchange/deck/dyna_expression.h"

namespace spia {
namespace {

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
        (local ? values_.back() : values_.front())[lower_case(trimmed(name.substr(1)))] = std::string(trimmed(value));
}

void DynaParameters::define(const DeckFields& card, bool local)
{
    for (size_t i = 0; i + 1 < card.count(); i += 2)
        set(trimmed(card[i]), card[i + 1], local);
}

void DynaParameters::define_expression(std::string_view line, int width, bool local)
{
    size_t comma = line.find(',');
    if (comma != line.npos && line.substr(0, comma).find('(') != line.npos)
        comma = line.npos; // one between arguments
    const size_t cut = comma != line.npos ? comma : std::min(line.size(), size_t(width));
    const std::string_view text = trimmed(line.substr(std::min(line.size(), comma != line.npos ? cut + 1 : cut)));
    const std::string_view name = trimmed(line.substr(0, cut));
    if (name.empty() || read_number(text)) {
        set(name, text, local);
        return;
    }
    const std::optional<double> value =
        dyna_expression(text, [&](const std::string& of) { return known(lower_case(of)); });
    if (value)
        set(name, fmt::format("{:.17g}", std::tolower(name.front()) == 'i' ? std::trunc(*value) : *value), local);
}

std::optional<std::string> DynaParameters::known(const std::string& name) const
{
    for (auto file = values_.rbegin(); file != values_.rend(); ++file)
        if (const auto found = file->find(name); found != file->end())
            return found->second;
    return std::nullopt;
}

std::optional<std::string> DynaParameters::find(std::string_view field)
{
    const bool minus = field.starts_with('-');
    const std::string name = lower_case(trimmed(field.substr(minus ? 2 : 1)));
    if (const std::optional<std::string> value = known(name))
        return minus ? negative(*value) : value;
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
