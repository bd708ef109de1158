#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "engine/exchange/deck/dyna_values.h"

namespace spia {

/// *DEFINE_TRANSFORMATION of an LS-DYNA deck: MIRROR, SCALE, ROTATE, TRANSL, POINT and POS6P, one
/// after the other. [LS-DYNA Keyword User's Manual, volume I]
class DynaTransforms {
public:
    explicit DynaTransforms(DynaValues& values) : values_(values) {}

    void begin(const DynaKeyword& keyword);
    void card(std::string_view line);

    /// In the unit of the deck. Nothing if it is not defined, or has an option that is not read.
    std::optional<Eigen::Affine3d> find(std::int64_t id) const;

private:
    Eigen::Vector3d vector(size_t first); ///< fields first, first + 1, first + 2 of the card
    std::optional<Eigen::Vector3d> point(size_t field) const;
    std::optional<Eigen::Affine3d> step(const std::string& option);
    std::optional<Eigen::Affine3d> rotation();
    std::optional<Eigen::Affine3d> between_points();

    DynaValues& values_;
    bool title_next_ = false;
    /// of the block; none: it comes with the next card
    std::optional<std::int64_t> id_;
    std::map<std::int64_t, Eigen::Vector3d> point_;                  ///< of the block
    std::map<std::int64_t, std::optional<Eigen::Affine3d>> defined_; ///< nothing: it cannot be read
};

} // namespace spia
