#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/exchange/deck_builder.h"
#include "engine/exchange/deck_fields.h"
#include "engine/exchange/deck_lines.h"

namespace spia {

/// /TRANSFORM/TRA, ROT, SYM and SCA of a Radioss deck, and the groups of nodes that they move: /GRNOD/NODE and /GRNOD/PART. [Altair
/// Radioss Starter Reference Guide]
class RadiossTransforms {
public:
    RadiossTransforms(DeckLines& lines, DeckBuilder& deck) : lines_(lines), deck_(deck) {}

    bool begin_group(std::string_view kind, std::int64_t id);     ///< false: such groups are not read
    bool begin_transform(std::string_view kind, bool other_unit); ///< false: such ones are not read
    void group(std::string_view line, int card);                  ///< @param card  counted from 0, the title
    void transform(std::string_view line, int card);

    void apply(); ///< one after the other, when all of the deck is read

private:
    enum class Kind { tra, rot, sym, sca };
    struct Transform {
        Kind kind;
        std::int64_t group = 0;
        std::array<std::int64_t, 2> node = {}; ///< that give the two points; 0: the coordinates do
        std::int64_t submodel = 0;
        Eigen::Vector3d first = Eigen::Vector3d::Zero(), second = Eigen::Vector3d::Zero();
        double angle = 0; ///< degrees
    };
    struct Group {
        bool of_parts = false;
        std::vector<std::int64_t> ids;
    };
    Eigen::Vector3d vector(size_t first) const;
    std::optional<Eigen::Affine3d> move_of(const Transform& transform) const;

    DeckLines& lines_;
    DeckBuilder& deck_;
    DeckFields fields_;
    std::int64_t group_ = 0; ///< that is read
    std::map<std::int64_t, Group> groups_;
    std::vector<Transform> transforms_;
};

} // namespace spia
