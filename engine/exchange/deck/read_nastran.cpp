#include <algorithm>
#include <fmt/core.h>

#include "engine/core/read_number.h"
#include "engine/core/text.h"
#include "engine/exchange/deck/deck_builder.h"
#include "engine/exchange/deck/nastran_entries.h"
#include "engine/exchange/deck/nastran_systems.h"
#include "engine/exchange/deck/read_deck.h"
#include "engine/mesh/doctor/doctor.h"

// Entry layouts: Quick Reference Guide of MSC and NX Nastran (GRID, GRDSET, CORD1R, CORD2R, CTRIA3,
// CQUAD4, PSHELL).
namespace spia {
namespace {

bool is_solid_or_bar(const std::string& name)
{
    for (const char* start : {"CHEXA", "CTETRA", "CPENTA", "CPYRA",  "CBAR", "CBEAM",  "CBEND",  "CROD",  "CONROD",
                              "CTUBE", "CELAS",  "CBUSH",  "CSHEAR", "CGAP", "CQUADX", "CTRIAX", "CVISC", "CDAMP",
                              "CWELD", "CFAST",  "CONM",   "CMASS",  "RBE",  "RBAR",   "PLOTEL"})
        if (name.starts_with(start))
            return true;
    return false;
}

class NastranReader {
public:
    explicit NastranReader(DeckLines& lines) : lines_(lines), entry_(lines) {}

    Deck read()
    {
        while (entry_.next())
            take();
        place_nodes();
        name_parts();
        thicken_shells();
        return deck_.finish("Nastran bulk data", lines_);
    }

private:
    struct Node {
        std::int64_t id, system; ///< system -1: as GRDSET says
        Eigen::Vector3d coordinates;
    };

    void take()
    {
        const std::string& name = entry_.name();
        if (name == "GRID")
            node();
        else if (name == "CQUAD4" || name == "CQUADR" || name == "CQUAD8" || name == "CQUAD")
            shell(4);
        else if (name == "CTRIA3" || name == "CTRIAR" || name == "CTRIA6")
            shell(3);
        else if (name == "PSHELL")
            property();
        else if (name == "PCOMP")
            composite();
        else if (name == "GRDSET")
            usual_system_ = lines_.whole_or_zero(entry_[1]);
        else if (name == "CORD2R" || name == "CORD2C" || name == "CORD2S")
            system(name.back());
        else if (name == "CORD1R" || name == "CORD1C" || name == "CORD1S")
            systems_by_nodes(name.back());
        // MATS1 adds to MAT1
        else if (name.starts_with("MAT") && name.size() > 3 && name[3] >= '0' && name[3] <= '9')
            material_[lines_.whole_or_zero(entry_[0])] = name;
        else if (is_solid_or_bar(name))
            deck_.count_other_elements(name);
        else
            deck_.count_skipped(name);
    }

    void node()
    {
        entry_.require_whole();
        Node node{lines_.whole(entry_[0]), entry_[1].empty() ? -1 : lines_.whole(entry_[1]), Eigen::Vector3d::Zero()};
        for (int k = 0; k < 3; ++k)
            if (const std::string_view x = entry_[size_t(2 + k)]; !x.empty())
                node.coordinates[k] = lines_.coordinate(x);
        nodes_.push_back(node);
    }

    void shell(size_t corners)
    {
        entry_.require_whole();
        const std::int64_t id = lines_.whole(entry_[0]);
        std::array<std::int64_t, 4> corner = {};
        for (size_t k = 0; k < corners; ++k)
            corner[k] = lines_.whole(entry_[2 + k]);
        if (entry_.name() == "CQUAD8" || entry_.name() == "CTRIA6" || entry_.name() == "CQUAD")
            ++middle_nodes_;
        const std::int64_t property = entry_[1].empty() ? id : lines_.whole(entry_[1]);
        deck_.add_shell(deck_.part(property), id, corner);
        if (entry_.name().back() == '4' || entry_.name().back() == '3')
            fields_behind_corners(corners);
    }

    /// Of a CQUAD4 or CTRIA3: direction and offset, then the thickness at each corner.
    void fields_behind_corners(size_t corners)
    {
        not_written_back_ += !entry_[2 + corners].empty() || !entry_[3 + corners].empty();
        CornerThickness own{deck_.shells() - 1, corners, lines_.whole_or_zero(entry_[9]) != 0, {}};
        bool given = false;
        for (size_t k = 0; k < corners; ++k)
            if (const std::string_view t = entry_[10 + k]; !t.empty()) {
                own.corner[k] = lines_.number(t);
                given = true;
            }
        if (given)
            own_thickness_.push_back(own);
    }

    /// Relative ones are shares of the property's, corners without one have that of the property.
    /// [Quick Reference Guide, CQUAD4: TFLAG, Ti]
    void thicken_shells()
    {
        for (const CornerThickness& own : own_thickness_) {
            const double usual = deck_.at(deck_.part_of_shell(own.shell)).thickness.value_or(0);
            std::array<double, 4> thick = {};
            for (size_t k = 0; k < own.corners; ++k)
                thick[k] = !own.corner[k] ? usual : own.relative ? *own.corner[k] * usual : *own.corner[k];
            const auto corners = std::span(thick).first(own.corners);
            if (std::all_of(corners.begin(), corners.end(), [](double t) { return t > 0; }))
                deck_.set_thickness(own.shell, mean(corners));
            else
                ++unknown_thickness_;
        }
        if (entry_.end_missing())
            deck_.doubt("the deck does not end with ENDDATA: if it was cut off, shells are missing");
        if (unknown_thickness_ > 0)
            deck_.note(fmt::format("{} a thickness at some corners only or as a share, and their property has none",
                                   counted(unknown_thickness_, "shell has", "shells have")));
        if (not_written_back_ > 0)
            deck_.note(
                fmt::format("{} a material direction or an offset; what is written for this deck does not repeat them",
                            counted(not_written_back_, "shell has", "shells have")));
    }

    void property()
    {
        entry_.require_whole();
        DeckPart& part = deck_.at(deck_.part(lines_.whole(entry_[0])));
        if (!entry_[1].empty())
            part.material_id = lines_.whole(entry_[1]);
        if (!entry_[2].empty())
            part.thickness = lines_.number(entry_[2]);
    }

    /// The thickness of a laminate is that of its layers: material, thickness, angle, output from
    /// the ninth field on.
    void composite()
    {
        entry_.require_whole();
        double sum = 0, last = 0;
        for (size_t k = 8; !entry_[k].empty() || !entry_[k + 1].empty() || !entry_[k + 2].empty(); k += 4) {
            if (!entry_[k + 1].empty())
                last = lines_.number(entry_[k + 1]);
            sum += last;
        }
        DeckPart& part = deck_.at(deck_.part(lines_.whole(entry_[0])));
        if (!entry_[8].empty())
            part.material_id = lines_.whole(entry_[8]);
        if (sum > 0)
            part.thickness = same_letters(entry_[7], "SYM") ? 2 * sum : sum;
    }

    static NastranSystems::Kind kind_of(char letter)
    {
        return letter == 'R'   ? NastranSystems::Kind::rectangular
               : letter == 'C' ? NastranSystems::Kind::cylindrical
                               : NastranSystems::Kind::spherical;
    }

    void system(char letter)
    {
        entry_.require_whole();
        const std::int64_t reference = lines_.whole_or_zero(entry_[1]);
        NastranSystems::System system{kind_of(letter), {reference, reference, reference}, Eigen::Matrix3d::Zero()};
        for (int k = 0; k < 9; ++k)
            if (const std::string_view x = entry_[size_t(2 + k)]; !x.empty())
                system.points(k % 3, k / 3) = lines_.coordinate(x);
        systems_.add(lines_.whole(entry_[0]), system);
    }

    /// One entry has up to two of them, each of four fields.
    void systems_by_nodes(char letter)
    {
        entry_.require_whole();
        for (const size_t at : {size_t(0), size_t(4)})
            if (!entry_[at].empty())
                by_nodes_.push_back(
                    {lines_.whole(entry_[at]),
                     kind_of(letter),
                     {lines_.whole(entry_[at + 1]), lines_.whole(entry_[at + 2]), lines_.whole(entry_[at + 3])}});
    }

    /// Nodes may stand behind the systems that they make.
    void add_systems_by_nodes()
    {
        std::map<std::int64_t, const Node*> node;
        for (const SystemByNodes& system : by_nodes_)
            for (const std::int64_t id : system.node)
                node[id] = nullptr;
        for (const Node& each : nodes_)
            if (const auto wanted = node.find(each.id); wanted != node.end())
                wanted->second = &each;
        for (const SystemByNodes& each : by_nodes_) {
            NastranSystems::System system{each.kind, {}, Eigen::Matrix3d::Zero()};
            bool whole = true;
            for (size_t k = 0; k < 3; ++k) {
                const Node* const at = node.at(each.node[k]);
                whole &= at != nullptr;
                if (!at)
                    continue;
                system.reference[k] = system_of(*at);
                system.points.col(Eigen::Index(k)) = at->coordinates;
            }
            if (whole)
                systems_.add(each.id, system);
        }
    }

    std::int64_t system_of(const Node& node) const { return node.system < 0 ? usual_system_ : node.system; }

    void place_nodes()
    {
        add_systems_by_nodes();
        int unplaced = 0;
        std::int64_t first = 0, in_system = 0;
        for (const Node& node : nodes_) {
            const std::int64_t system = system_of(node);
            if (const auto place = systems_.in_space(system, node.coordinates))
                deck_.add_node(node.id, *place);
            else if (unplaced++ == 0) {
                first = node.id;
                in_system = system;
            }
        }
        if (unplaced > 0)
            deck_.doubt(
                fmt::format("{} left out, for their coordinate systems are not given by CORD1R, CORD1C, CORD1S, "
                            "CORD2R, CORD2C or CORD2S (first: node {} in system {})",
                            counted(unplaced, "node is", "nodes are"), first, in_system));
        if (middle_nodes_ > 0)
            deck_.note(fmt::format("{} nodes between corners; the corners are taken",
                                   counted(middle_nodes_, "shell has", "shells have")));
    }

    void name_parts()
    {
        for (int p = 0; p < deck_.parts(); ++p) {
            DeckPart& part = deck_.at(p);
            if (const auto name = entry_.property_names().find(*part.id); name != entry_.property_names().end())
                part.name = name->second;
            if (const auto name = material_.find(part.material_id.value_or(0)); name != material_.end())
                part.material = name->second;
        }
    }

    struct CornerThickness {
        size_t shell, corners;
        bool relative;
        std::array<std::optional<double>, 4> corner;
    };
    struct SystemByNodes {
        std::int64_t id;
        NastranSystems::Kind kind;
        std::array<std::int64_t, 3> node; ///< origin, on the third axis, in the plane of the first
                                          ///< and third
    };
    std::vector<SystemByNodes> by_nodes_;
    DeckLines& lines_;
    NastranEntries entry_;
    DeckBuilder deck_;
    NastranSystems systems_;
    std::vector<Node> nodes_; // coordinate systems may come behind them
    std::int64_t usual_system_ = 0;
    std::vector<CornerThickness> own_thickness_; // their properties may come behind them
    int middle_nodes_ = 0, unknown_thickness_ = 0, not_written_back_ = 0;
    std::map<std::int64_t, std::string> material_;
};

} // namespace

Deck read_nastran(DeckLines& lines) { return NastranReader(lines).read(); }

} // namespace spia
