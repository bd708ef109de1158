#include "engine/exchange/iga/iga_patches.h"

#include <fmt/format.h>
#include <iterator>

#include "engine/core/error.h"
#include "engine/exchange/cad/occt_surface.h"
#include "engine/exchange/provenance.h"
#include "engine/exchange/text/text_encoding.h"

namespace spia {
namespace {

template <class Numbers> std::string row(const Numbers& numbers)
{
    std::string text;
    for (const double number : numbers)
        fmt::format_to(std::back_inserter(text), "{}{}", text.empty() ? "" : " ",
                       number + 0.0); // no minus before a zero
    return text;
}

} // namespace

MultiPatch patches_in(LengthUnit unit, const MultiPatch& patches_mm)
{
    if (patches_mm.patch.empty())
        throw InputError("there is no surface to write; fit one first");
    MultiPatch result = patches_mm;
    for (NurbsSurface& patch : result.patch) {
        require_exchangeable(patch);
        patch.control /= millimetres(unit);
    }
    require_watertight(result);
    return result;
}

PatchField field_in(LengthUnit unit, const MultiPatch& patches, const PatchField& field)
{
    PatchField result = field;
    if (field.unit == "mm") {
        result.unit = name(unit);
        for (Eigen::VectorXd& value : result.value)
            value /= millimetres(unit);
    }
    require_field(patches, result);
    return result;
}

bool is_rational(const NurbsSurface& patch) { return (patch.weight.array() != 1).any(); }

std::string row_of(std::span<const double> numbers) { return row(numbers); }

std::string row_of(const Eigen::Ref<const Eigen::VectorXd>& numbers) { return row(numbers); }

std::string head_line(std::string_view name, std::string_view what, LengthUnit unit)
{
    std::string shown = readable(name);
    for (char& c : shown)
        c = c == '\n' || c == '\r' ? ' ' : c;
    for (size_t at; (at = shown.find("--")) != shown.npos;)
        shown.replace(at, 2, "- ");
    constexpr size_t most = 120;
    if (shown.size() > most) {
        shown.resize(most);
        while ((static_cast<unsigned char>(shown.back()) & 0xc0) == 0x80) // the middle of a letter
            shown.pop_back();
        shown.pop_back();
    }
    return fmt::format("{}: {}, {}; lengths {}", program_name(), shown, what, spia::name(unit));
}

} // namespace spia
