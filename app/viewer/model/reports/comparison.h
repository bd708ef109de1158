#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/model/document/state.h"

/// Two runs side by side: a result that was kept as reference, and the one that there is now.
/// Differences are now minus reference.
namespace spia::viewer {

/// A result that was kept.
struct Reference {
    std::string name; ///< "mild_steel, 0.8 mm, 14:05"
    std::shared_ptr<const PartFile> part;
    std::shared_ptr<const FlattenResult> blank;
    std::shared_ptr<const LimitsResult> limits; ///< null: none were judged
};

/// @param name  empty: material, thickness and the time of day
/// @throws InputError if there is no blank
Reference reference_of(const Document& document, std::string name, LengthUnit lengths = LengthUnit::mm);

/// What the present blank differs by from a reference.
struct Differences {
    std::shared_ptr<const Reference> reference;
    std::shared_ptr<const PartFile> part;       ///< of the present blank
    std::shared_ptr<const FlattenResult> blank; ///< the present one

    /// Why there are no differences face by face, a sentence; empty: there are.
    std::string none_because;
    std::shared_ptr<const FlattenResult> fields; ///< the present blank, its fields less those of
                                                 ///< the reference; null: none_because
    Eigen::Matrix2Xd outline;                    ///< 2 by #V, mm: the blank of the reference,
                                                 ///< turned and moved onto the present one
    double outline_distance = 0;                 ///< mm, the greatest one from any point of either
                                                 ///< outline to the other one
};
/// All but the fields needs the same triangles; where they differ `none_because` says so.
Differences differences_of(const std::shared_ptr<const Reference>& reference, const Session& now);

/// Whether a difference of the field can be told of the fields of two blanks.
bool has_difference(Field field);
/// The result whose values the views and charts show: the differences where they are asked for,
/// else the blank itself.
const std::shared_ptr<const FlattenResult>& blank_of_field(const ViewerState& state);
/// The session with that result in place of its blank, for values().
Session session_of_field(const ViewerState& state);
/// What the field is called: "Thinning, now minus reference".
std::string label_of_field(const ViewerState& state);

/// A row of the table; a number that is not there is not known of that result.
struct ComparedFigure {
    std::string name, unit;
    std::optional<double> reference, now;
    int decimals = 1;
};
/// The same where lengths are shown otherwise, with decimals that are as fine.
ComparedFigure in_unit(ComparedFigure figure, LengthUnit lengths);
std::vector<ComparedFigure> compared_figures(const Reference& reference, const Session& now);

/// The least turn and shift that lays points onto others of the same number, by least squares. 2 by
/// n, mm
Eigen::Matrix2Xd laid_over(const Eigen::Matrix2Xd& points, const Eigen::Matrix2Xd& onto);

} // namespace spia::viewer
