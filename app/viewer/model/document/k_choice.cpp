#include "app/viewer/model/document/k_choice.h"

#include <filesystem>

namespace spia::viewer {

KSource k_source(const std::optional<KFactor>& k)
{
    if (!k)
        return KSource::automatic;
    if (k->name == din6935_k().name)
        return KSource::din6935;
    return k->one_value() && k->name == constant_k(k->table[0].second).name ? KSource::number : KSource::table;
}

std::string k_words(const std::optional<KFactor>& k)
{
    switch (k_source(k)) {
    case KSource::automatic: return "0.5, middle surface";
    case KSource::number: break;
    case KSource::din6935: return "DIN 6935";
    case KSource::table: return std::filesystem::path(k->name).filename().string();
    }
    return k->name;
}

std::string k_text(const std::optional<KFactor>& k) { return k ? k->name : ""; }

SheetBend with_wanted_k(const Document& document, const SheetBend& bend)
{
    const Session& session = document.session;
    const BendTable& table = *session.bends;
    // A mesh without a K factor keeps its triangles; with one it has arcs in their place.
    const bool arcs_next =
        !session.part->cad && !session.part->solid && !document.made_with.k_factor && session.options.k_factor;
    if (!bend.laid && !arcs_next)
        return bend;
    // Of a skin the fibre lies where the skin lies, of a sharp fold where the legs meet.
    if (!table.of_middle || !(table.thickness > 0) || bend.sharp)
        return bend;
    const double k = session.options.k_factor.value_or(KFactor{}).at(bend.inner_radius / table.thickness);
    SheetBend now = bend;
    now.k = k;
    now.allowance += bend.angle * (k - bend.k) * table.thickness;
    now.deduction -= now.allowance - bend.allowance;
    return now;
}

} // namespace spia::viewer
