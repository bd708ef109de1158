#pragma once
#include <map>
#include <string>

#include "engine/exchange/deck/deck_builder.h"
#include "engine/exchange/deck/dyna_values.h"

namespace spia {

/// What an LS-DYNA deck says of its parts: *PART, *SECTION_SHELL and *MAT_..., in any order.
class DynaParts {
public:
    DynaParts(DynaValues& values, DeckBuilder& deck) : values_(values), deck_(deck) {}

    bool begin_part(const DynaKeyword& keyword); ///< false if such a block holds no parts of ours
    void part(std::string_view line);
    void begin_section(const DynaKeyword& keyword);
    void section(std::string_view line);
    void begin_material(const DynaKeyword& keyword);
    void material(std::string_view line);

    void finish(); ///< gives each part the thickness of its section and the name of its material

private:
    void begin(const DynaKeyword& keyword);
    void first_card();
    void ply();
    std::optional<double> mean_thickness();

    DynaValues& values_;
    DeckBuilder& deck_;

    std::string keyword_, title_;
    int count_ = 0;       // cards of the current entry so far; -1: all that is read of the block
    int more_ = 0;        // cards still to be passed over
    bool titled_ = false; // a title comes first
    bool repeats_ = true; // several sections may follow each other
    bool composite_ = false, long_plies_ = false, inertia_ = false;
    int cards_behind_ = 0; // of a part
    int part_ = 0;
    std::int64_t section_ = 0, layers_ = 0;

    struct Material {
        std::string keyword, title;
    };
    std::map<int, std::int64_t> section_of_;
    std::map<std::int64_t, std::optional<double>> sections_;
    std::map<std::int64_t, Material> materials_;
};

} // namespace spia
