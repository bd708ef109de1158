#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/exchange/deck/deck.h"
#include "engine/exchange/deck/deck_lines.h"

namespace spia {

/// Where an id first stands in a list that grows; what was looked at is not gone through again.
class IdIndex {
public:
    /// @param id_at  id of entry i < count
    template <class IdAt> std::optional<size_t> find(std::int64_t id, size_t count, const IdAt& id_at)
    {
        for (; known_ < count; ++known_)
            first_.try_emplace(id_at(known_), known_);
        const auto found = first_.find(id);
        return found == first_.end() ? std::nullopt : std::optional(found->second);
    }
    void start_at(size_t first) ///< forgets those before
    {
        first_.clear();
        known_ = first;
    }

private:
    std::unordered_map<std::int64_t, size_t> first_;
    size_t known_ = 0;
};

/// Nodes and shells of a builder that belong together, by their numbers as they were added; the
/// ends are not in it.
struct DeckRange {
    size_t first_node = 0, end_node = 0, first_shell = 0, end_shell = 0;
    size_t nodes() const { return end_node - first_node; }
    size_t shells() const { return end_shell - first_shell; }
};

/// Collects what a reader finds, in any order, and joins shells with their nodes at the end.
class DeckBuilder {
public:
    /// @throws InputError if there are more nodes than are read
    void add_node(std::int64_t id, const Eigen::Vector3d& position);

    /// The place of a node of the scope that is open, which is added if there is none of this id.
    void put_node(std::int64_t id, const Eigen::Vector3d& position);

    /// Most nodes and shells that keywords may make of others. Decks with such keywords are written
    /// by hand: some 100,000 are many. Copies of whole parts may be more.
    static constexpr std::uint64_t most_made = 1'000'000, most_copied = 10'000'000;

    /// To call before a keyword makes nodes or shells of others: few words of a file could ask for
    /// any number of them.
    /// @throws InputError with the line, if it and those before make more than this
    void require_room(const DeckLines& lines, std::string_view keyword, std::uint64_t count,
                      std::uint64_t most = most_made);

    /// Those that are there of these ids, sorted; or all; or a range of them.
    void move_nodes(std::span<const std::int64_t> ids, const Eigen::Affine3d& move);
    void move_all_nodes(const Eigen::Affine3d& move);
    void move_range(const DeckRange& range, const Eigen::Affine3d& move);
    size_t nodes() const { return deck_.node.size(); }
    std::span<const std::int64_t> scope_node_ids() const { return std::span(deck_.node).subspan(first_node_); }
    std::optional<size_t> number_of_node(std::int64_t id); ///< of the scope that is open
    std::optional<Eigen::Vector3d> node(std::int64_t id);  ///< of the scope that is open
    std::vector<std::int64_t> nodes_of(int part) const;    ///< sorted ids, of the scope that is
                                                           ///< open

    /// @param part       number of a part
    /// @param corners    ids of three or four nodes; a fourth that is 0 or repeats the third makes
    ///         a triangle
    /// @param thickness  of this element; 0: that of its part
    void add_shell(int part, std::int64_t id, std::span<const std::int64_t> corners, double thickness = 0);

    int part(std::int64_t id);             ///< its number; a new one if there is none of this id
    int part_named(std::string_view name); ///< the same for parts that have no id
    DeckPart& at(int part) { return deck_.parts[size_t(part)]; }
    int parts() const { return int(deck_.parts.size()); }

    /// Shells so far look for their nodes among the nodes so far, and what follows has ids of its
    /// own (Abaqus: *PART).
    void close_scope();
    /// the one that is open
    DeckRange scope() const { return {first_node_, nodes(), first_shell_, shells()}; }
    /// Adds nodes and shells of a scope that is closed once more, moved, with the same ids, as a
    /// scope of their own.
    /// @param part_of  the part of a copy by that of its original
    void copy(const DeckRange& range, const Eigen::Affine3d& move, const std::function<int(int)>& part_of);
    void drop_shells(const DeckRange& range); ///< of a scope that is closed
    /// number of the first shell since, as they were added
    size_t first_of_scope() const { return first_shell_; }
    std::optional<size_t> number_of_shell(std::int64_t id); ///< of the scope that is open
    /// Ids of the nodes of a shell of the scope that is open: three or four.
    std::span<const std::int64_t> corners(size_t shell) const
    {
        return std::span(shell_[shell].corner).first(shell_[shell].triangle ? 3 : 4);
    }
    size_t shells() const { return shell_.size(); }
    std::int64_t shell_id(size_t shell) const { return shell_[shell].id; }
    void move_shell(size_t shell, int part) { shell_[shell].part = part; }
    int part_of_shell(size_t shell) const { return shell_[shell].part; }
    void set_thickness(size_t shell, double thickness); ///< of its own, as in add_shell()
    /// by their numbers as they were added
    void add_set(std::string name, std::vector<int> shells);
    size_t sets() const { return deck_.sets.size(); }
    DeckSet& set(size_t number) { return deck_.sets[number]; }
    void drop_empty_sets();

    void note(std::string text) { deck_.notes.push_back(std::move(text)); }
    void doubt(std::string text) ///< a note after which shells may be missing
    {
        deck_.doubts.push_back(text);
        note(std::move(text));
    }
    void count_skipped(std::string_view keyword) { count(skipped_, keyword); } ///< not read
    /// Not read, and nodes or shells are missing without it, or lie where they should not.
    void count_unread_geometry(std::string_view keyword) { count(unread_geometry_, keyword); }
    void set_copies() { deck_.copies = true; }
    void count_other_elements(std::string_view type) { count(others_, type); } ///< no shell

    /// @throws InputError if a node is given twice at different places, or there is no shell
    /// @param lines  read to their end; their notes are put before those of the builder
    Deck finish(std::string format, const DeckLines& lines);
    void set_unit(LengthUnit unit) { deck_.unit = unit; }

private:
    struct Shell {
        std::int64_t id;
        std::array<std::int64_t, 4> corner; ///< ids of nodes; their numbers once the scope is
                                            ///< closed, -1: not there
        int part;
        bool triangle;
    };
    void begin_scope();
    static void count(std::map<std::string, int, std::less<>>& counts, std::string_view name);
    void drop_absurd_thicknesses();
    void thickness_from_elements();
    void write_notes();

    Deck deck_;
    std::vector<Shell> shell_;
    std::vector<double> thickness_; ///< per shell, or empty if none has its own
    std::unordered_map<std::int64_t, int> part_of_id_;
    std::map<std::string, int, std::less<>> part_of_name_;
    std::map<std::string, int, std::less<>> skipped_, others_, unread_geometry_;
    size_t first_node_ = 0, first_shell_ = 0;
    IdIndex node_index_, shell_index_; ///< of the scope that is open
    std::uint64_t made_ = 0;           ///< nodes and shells that keywords made of others
};

} // namespace spia
