#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/exchange/deck/abaqus_keyword.h"
#include "engine/exchange/deck/deck_builder.h"
#include "engine/exchange/deck/deck_fields.h"
#include "engine/exchange/deck/deck_lines.h"
#include "engine/exchange/deck/node_sets.h"

namespace spia {

/// A number or increment of a node or element in a keyword that makes others.
/// @throws InputError with the line, if it is none or beyond what Abaqus takes
std::int64_t abaqus_number(const DeckLines& lines, std::string_view field);
/// @throws InputError with the line, if the sum is no number of a node or an element
std::int64_t shifted_number(const DeckLines& lines, std::int64_t number, std::int64_t by);

/// A translation, then a turn in degrees about the axis from one point to another, as the lines of
/// *NCOPY, SHIFT and of *INSTANCE give them: three numbers, and seven.
struct AbaqusShift {
    Eigen::Vector3d by = Eigen::Vector3d::Zero();
    Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();
    double degrees = 0;

    void take(const DeckLines& lines, const DeckFields& fields); ///< one line of it
    /// @param times  the turn is made; the translation is made once
    Eigen::Affine3d move(const DeckLines& lines, double times = 1) const;
};

/// The nodes of an Abaqus deck: *NODE in its coordinates and in those of *SYSTEM, the nodes that
/// *NGEN, *NFILL and *NCOPY make of others, and *NSET. [Abaqus Keywords Reference; Abaqus Analysis
/// User's Guide, "Node definition"]
class AbaqusNodes {
public:
    AbaqusNodes(DeckLines& lines, DeckBuilder& deck) : lines_(lines), deck_(deck), sets_(lines) {}

    bool begin(const AbaqusKeyword& keyword); ///< whether the block is read here: its lines go to
                                              ///< card(), then end()
    void card(const DeckFields& fields) { (this->*card_)(fields); }
    void end();
    void close_scope(); ///< forgets sets and system

private:
    using Card = void (AbaqusNodes::*)(const DeckFields&);
    enum class Kind { rectangular, cylindrical, spherical };
    struct Copy {
        std::string set, new_set;
        std::int64_t change = 0, times = 1;
        enum class How { shift, line, mirror, point, pole } how = How::shift;
        AbaqusShift shift = {};
        std::vector<Eigen::Vector3d> points = {};
        DeckLines::Place place = {};
    };
    struct Fill {
        double bias = 1; ///< each interval over the next one
        bool two_step = false;
    };
    void begin_nodes(const AbaqusKeyword& keyword);
    void begin_set(const AbaqusKeyword& keyword);
    void begin_generation(const AbaqusKeyword& keyword);
    void begin_fill(const AbaqusKeyword& keyword);
    void begin_copy(const AbaqusKeyword& keyword);

    void node(const DeckFields& fields);
    void system(const DeckFields& fields);
    void listed(const DeckFields& fields);
    void range(const DeckFields& fields);
    void generate(const DeckFields& fields);
    void fill(const DeckFields& fields);
    void fill_line(std::int64_t first, std::int64_t last, std::int64_t step,
                   const std::pair<Eigen::Vector3d, Eigen::Vector3d>& ends, const std::vector<double>& parts);
    void copy_line(const DeckFields& fields);
    void unread(const DeckFields&) {}

    Kind kind_of(std::string_view system) const;
    Eigen::Vector3d point(const DeckFields& fields, size_t first) const;
    static Eigen::Vector3d rectangular(Kind kind, const Eigen::Vector3d& x);
    void place_system();
    Eigen::Vector3d place_of(std::int64_t node);
    void put(std::int64_t node, const Eigen::Vector3d& x);
    void leave_unread(std::string_view what, std::string_view why);
    bool is_in_system() const { return !system_.isApprox(Eigen::Affine3d::Identity(), 0); }

    void generate_arc(const DeckFields& fields, std::int64_t first, std::int64_t step, std::int64_t intervals);
    std::optional<Eigen::Vector3d> centre_of(const DeckFields& fields);
    std::vector<double> parts_of_lines(std::int64_t intervals) const;
    std::optional<NodeSets::Members> members(std::string_view keyword, std::string_view set);
    void make_copy();
    Eigen::Affine3d move_of_copy() const;

    DeckLines& lines_;
    DeckBuilder& deck_;
    NodeSets sets_;
    Card card_ = nullptr;
    Kind kind_ = Kind::rectangular; ///< of nodes, or of the centres of arcs
    std::string set_;               ///< that takes the nodes; empty: none
    bool arcs_ = false;
    Fill fill_;
    std::optional<Copy> copy_;
    Eigen::Affine3d system_ = Eigen::Affine3d::Identity(); ///< of the nodes that are read
    std::vector<Eigen::Vector3d> system_points_;
    bool reported_spherical_ = false;
    int reported_ = 0;
    std::int64_t steps_ = 100'000'000; ///< of members looked up: a few seconds
};

} // namespace spia
