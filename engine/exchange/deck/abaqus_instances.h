#pragma once
#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/exchange/deck/abaqus_keyword.h"
#include "engine/exchange/deck/abaqus_nodes.h"
#include "engine/exchange/deck/deck_builder.h"
#include "engine/exchange/deck/deck_fields.h"
#include "engine/exchange/deck/deck_lines.h"

namespace spia {

/// The parts of an Abaqus deck and their instances in the assembly, each at its place. [Abaqus
/// Analysis User's Guide, "Assembly definition"]
class AbaqusInstances {
public:
    AbaqusInstances(DeckLines& lines, DeckBuilder& deck) : lines_(lines), deck_(deck) {}

    void begin_part(std::string_view name) { part_ = upper_case(name); }
    void begin_instance(const AbaqusKeyword& keyword);
    /// a line of the instance
    void placement(const DeckFields& fields) { instance_->shift.take(lines_, fields); }
    /// Of the part or instance that is open, if there is one.
    /// @param first_set  of its sets; those behind are its own as well
    void end_scope(const DeckRange& scope, size_t first_set);
    /// Moves every part to its first instance and copies it for the others; parts without any are
    /// left out.
    void place_all();

private:
    struct Instance {
        std::string name;
        AbaqusShift shift = {};
        std::string part = {}; ///< upper case
        bool lost = false;     ///< there is no such part
    };
    struct Placed {
        std::string name;
        Eigen::Affine3d move;
    };
    struct Part {
        DeckRange range;
        size_t first_set = 0, end_set = 0;
        std::vector<Placed> placed = {};
    };
    void copy(const Part& part, const Placed& placed);

    DeckLines& lines_;
    DeckBuilder& deck_;
    std::optional<std::string> part_;   ///< that is read
    std::optional<Instance> instance_;  ///< that is read
    std::map<std::string, Part> parts_; ///< by upper-case name
    int placed_ = 0, lost_ = 0;
    size_t set_room_ = 16'000'000; ///< members of sets of copies: 64 MB
};

} // namespace spia
