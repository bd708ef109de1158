#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/exchange/deck/deck_builder.h"
#include "engine/exchange/deck/deck_fields.h"
#include "engine/exchange/deck/deck_lines.h"
#include "engine/exchange/deck/radioss_submodels.h"

namespace spia {

/// /TRANSFORM/TRA, ROT, SYM and SCA of a Radioss deck, and what they move: the groups of nodes
/// /GRNOD/NODE and /GRNOD/PART, and by TRA and ROT submodels. [Altair Radioss Starter Reference
/// Guide]
class RadiossTransforms {
public:
    RadiossTransforms(DeckLines& lines, DeckBuilder& deck, const RadiossSubmodels& submodels)
        : lines_(lines), deck_(deck), submodels_(submodels)
    {
    }

    /// false: such groups are not read
    bool begin_group(std::string_view kind, std::int64_t id);
    bool begin_transform(std::string_view kind, bool other_unit); ///< false: such ones are not read
    /// @param card counted from 0, the title
    void group(std::string_view line, int card);
    void transform(std::string_view line, int card);

    void apply(); ///< one after the other, when all of the deck is read

private:
    enum class Kind { tra, rot, sym, sca };
    struct Transform {
        Kind kind;
        std::int64_t group = 0;
        std::array<std::int64_t, 2> node = {}; ///< that give the two points; 0: the coordinates do
        std::int64_t submodel = 0;
        int inside = -1; ///< of the submodel that it stands in
        Eigen::Vector3d first = Eigen::Vector3d::Zero(), second = Eigen::Vector3d::Zero();
        double angle = 0; ///< degrees
    };
    struct Group {
        bool of_parts = false;
        std::vector<std::int64_t> ids;
    };
    Eigen::Vector3d vector(size_t first) const;
    /// @param submodel  that is moved, by moves_ so far; -1: none
    std::optional<Eigen::Affine3d> move_of(const Transform& transform, int submodel);
    void take_inside(Transform& transform) const;
    void move_submodels();
    void move_group(const Transform& transform);
    void spend(std::uint64_t nodes);

    DeckLines& lines_;
    DeckBuilder& deck_;
    const RadiossSubmodels& submodels_;
    DeckFields fields_;
    std::int64_t group_ = 0; ///< that is read
    std::map<std::int64_t, Group> groups_;
    std::vector<Transform> transforms_;
    std::vector<Eigen::Affine3d> moves_; ///< of each submodel, at last with those of the ones
                                         ///< around it
    std::uint64_t work_ = 0;             ///< nodes looked at
};

} // namespace spia
